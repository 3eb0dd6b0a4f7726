#include "app/bake/subpatch_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "app/bake/enclosing_ball.h"
#include "app/bake/patch_bounds.h"
#include "app/bake/subpatch_fit.h"
#include "app/base/max_propagating_nan.h"
#include "app/base/parallel_rows.h"
#include "app/base/rounding.h"
#include "app/surface/control_net.h"
#include "app/surface/surface_float.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec3;

using in_double::SubTriangle;

// The quadratic of a subpatch must follow the surface to this part of the longest edge of the
// sub-triangle, and the tangents to this part of the longest edge of the patch; otherwise the
// subpatch is divided, at most so many times. One that may be nonsmooth, whose tangents no
// quadratic follows, is divided twice more as long as a quarter of it is smooth, which leaves the
// place about a vertex out; then by the kernel, for the few rays that come near.
constexpr double kClose = 0.02;
constexpr double kTangentsClose = 0.1;
constexpr int kMostLevels = 6;
constexpr int kMostLevelsOfNonsmooth = 8;

// The solver is fast for rays within a subpatch's cone (SubpatchBounds::cone), whose w should be at
// most `widest`; otherwise the subpatch is divided, for this reason only down to this level, a
// 4^levels-th of the patch.
struct ConeLimits {
  float widest;
  int levels;
};

// Every frame projects and bins all subpatches, so more of them have to pay. Up to so many patches
// they do: with the finer limits frames of 20 to 576 patches take 0.5 to 1 times as long (Mesa
// 25.0.7, lavapipe), of 1016 patches 1.1 times.
constexpr std::size_t kFewPatches = 600;
constexpr ConeLimits kLimitsOfFew{0.2F, 3};
constexpr ConeLimits kLimitsOfMany{0.3F, 2};
const vec4 kNoCone(0.0F, 0.0F, 0.0F, NO_CONE);

PatchData patch_data(const SurfaceChoice& choice, const Triangle& single) {
  return {shape_of(choice), to_double(single), patch_of(choice.shell, single),
          dvec3(in_float::edge_bulges(single, static_cast<float>(choice.alpha)))};
}

// The ball around a subpatch and its overlap with the neighbours.
Ball subpatch_ball(const PatchData& patch, const SubTriangle& sub_triangle, const Fit& fit) {
  std::vector<Ball> points;
  // Of a nonsmooth subpatch the corners of its pieces, displaced by the least and by the largest
  // sigma: where directions are long they are closer than the control points and position_error.
  for (const auto& [weights, corners, sigma] : fit.pieces) {
    if (!sigma) {
      points.push_back({dvec3(patch.tri.Domain), patch.tri.Domain.w});
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      points.push_back({corners.T[i] + corners.D[i] * sigma->lo, 0.0});
      points.push_back({corners.T[i] + corners.D[i] * sigma->hi, 0.0});
    }
  }
  if (fit.pieces.empty()) {
    const SubTriangle large = in_double::with_overlap(sub_triangle);
    for (const dvec3& point : control_points(patch.corners, fit.q, large)) {
      points.push_back({point, fit.position_error});
    }
  }
  Ball ball = enclosing_ball(points);
  ball.radius += kBoundSlack * (ball.radius + glm::length(ball.center));
  return ball;
}

// The spectral norm, the most by which a matrix lengthens a vector.
double norm_of(const glm::dmat2& m) {
  // Half the sum of its singular values plus half their difference.
  return 0.5 * (std::hypot(m[0][0] + m[1][1], m[0][1] - m[1][0]) +
                std::hypot(m[0][0] - m[1][1], m[0][1] + m[1][0]));
}

// SubpatchBounds::cone: the directions along which the enlarged subpatch projects one to one.
//
// S_u and S_v at a point are the same convex combination of the control vectors u_i and v_i. So is
// their mean on the way from one point to another, by which S differs between the two. n is the
// normal of the plane of the mean control vectors, M0 = (mean u, mean v) in that plane. Projected
// on it along a direction d, the mean between two points is (1 + E - t g^T) M0: E and g are convex
// combinations of the E_i and g_i below, from the parts of (u_i, v_i) in the plane and along n, and
// the length of the vector t is the tangent of the angle between d and n. If |E_i| + |t| |g_i| < 1
// for all i the mean is invertible, so no two points fall together. This is the contraction test of
// shaders/subpatch_bounds.glsl for all directions at once. It is a proof for the cubic T + q D; the
// tangent error of surfaces that are not cubic comes from samples.
//
// The cone is used like a cone of normals (Shirman & Abi-Ezzi 1993, "The cone of normals technique
// for fast processing of curved patches") but is another thing: that contains the directions of
// S_u x S_v, so that a line along which all of them look the same way crosses the surface in one
// sense only. Two points far apart may still be on one such line; here they cannot.
vec4 normal_cone(const PatchData& patch, const SubTriangle& sub_triangle, const Fit& fit) {
  const SubTriangle large = in_double::enlarged(sub_triangle, CONE_MARGIN);
  const auto [u, v] = tangent_net(patch.corners, fit.q, large);
  dvec3 mean_u(0.0);
  dvec3 mean_v(0.0);
  for (std::size_t i = 0; i < 6; ++i) {
    mean_u += u[i] / 6.0;
    mean_v += v[i] / 6.0;
  }
  const dvec3 n = glm::normalize(glm::cross(mean_u, mean_v));
  const dvec3 x = glm::normalize(mean_u);
  const dvec3 y = glm::cross(n, x);
  const auto in_plane = [&](const dvec3& a) { return glm::dvec2(glm::dot(a, x), glm::dot(a, y)); };
  const glm::dmat2 inverse = glm::inverse(glm::dmat2(in_plane(mean_u), in_plane(mean_v)));
  // By the weights within the sub-triangle, over 3, as the control vectors are; of both columns.
  const double tangent_error = tangent_error_over(patch, large, fit) * std::abs(large.size) / 3.0 *
                               std::sqrt(2.0) * norm_of(inverse);
  // The largest |g| / (1 - |E|), the cotangent of the smallest angle between d and n that is too
  // large.
  double flattest = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::dmat2 change =
        glm::dmat2(in_plane(u[i]), in_plane(v[i])) * inverse - glm::dmat2(1.0);
    const double room = 1.0 - norm_of(change) - tangent_error;
    // Written so that a NaN gives no cone.
    if (!(room > 0.0)) return kNoCone;
    const double rise =
        glm::length(glm::dvec2(glm::dot(u[i], n), glm::dot(v[i], n)) * inverse) + tangent_error;
    max_propagating_nan(flattest, rise / room);
  }
  constexpr double narrowest = 10.0;
  if (!(flattest < narrowest)) return kNoCone;
  // For the rounding of the ray's direction and of n to single precision.
  constexpr double rounding = 1e-5;
  return {glm::vec3(n), static_cast<float>(flattest / std::hypot(flattest, 1.0) + rounding)};
}

SubpatchBounds bounds_of(const PatchData& patch, const SubTriangle& sub_triangle, const Fit& fit,
                         uint32_t triangle) {
  SubpatchBounds bounds{};
  // The patch's ball unless the subpatch has a smaller one.
  bounds.ball = vec4(patch.tri.Domain);
  if (sub_triangle.size < 1.0) {
    const Ball ball = subpatch_ball(patch, sub_triangle, fit);
    if (ball.radius < patch.tri.Domain.w) {
      bounds.ball = vec4(glm::vec3(ball.center), rounded_up(ball.radius));
    }
  }
  bounds.sub_triangle = vec4(glm::vec3(sub_triangle.origin), static_cast<float>(sub_triangle.size));
  bounds.corner = vec4(glm::vec3(fit.q.corner), rounded_up(fit.position_error));
  bounds.edge = vec4(glm::vec3(fit.q.edge), rounded_up(fit.tangent_error));
  bounds.cone = kNoCone;
  bounds.triangle = triangle;
  bounds.gradient_lipschitz = rounded_up(fit.gradient_lipschitz);
  // Less than the roundings of a position.
  constexpr double nothing = 1e-9;
  const dvec3 most = glm::max(glm::abs(fit.q.corner), glm::abs(fit.q.edge));
  const double displacement =
      std::max({most.x, most.y, most.z}) * longest_of(patch.corners.D) + fit.position_error;
  const bool no_displacement = displacement <= nothing * patch.tri.TriNormal.w;
  // The kernel takes a flat subpatch for the whole triangle, so only an undivided patch may be one.
  bounds.is_flat = no_displacement && sub_triangle.size == 1.0 ? 1 : 0;
  return bounds;
}

bool has_smooth_quarter(const PatchData& patch, const SubTriangle& sub_triangle) {
  const auto quarters = quarter(sub_triangle);
  return std::any_of(quarters.begin(), quarters.end(),
                     [&](const SubTriangle& piece) { return !may_be_nonsmooth(patch, piece); });
}

// Appends the bounds of a sub-triangle and, if it is divided, those of its children after it.
void bound_subpatch(const PatchData& patch, const ConeLimits& limits,
                    const SubTriangle& sub_triangle, int level, uint32_t triangle,
                    std::vector<SubpatchBounds>& subpatches) {
  const Fit found = fit_subpatch(patch, sub_triangle);
  const double size = patch.tri.TriNormal.w * std::abs(sub_triangle.size);
  const bool close = found.position_error <= kClose * size &&
                     found.tangent_error <= kTangentsClose * patch.tri.TriNormal.w;
  const std::size_t index = subpatches.size();
  subpatches.push_back(bounds_of(patch, sub_triangle, found, triangle));
  const bool nonsmooth = subpatches[index].gradient_lipschitz == NONSMOOTH;
  const bool deepest = level >= kMostLevels && (!nonsmooth || level == kMostLevelsOfNonsmooth ||
                                                !has_smooth_quarter(patch, sub_triangle));
  if (close || deepest) {
    if (!nonsmooth) subpatches[index].cone = normal_cone(patch, sub_triangle, found);
    if (subpatches[index].cone.w <= limits.widest || level >= limits.levels) return;
  }
  for (const SubTriangle& child : quarter(sub_triangle)) {
    bound_subpatch(patch, limits, child, level + 1, triangle, subpatches);
  }
  subpatches[index].skip = static_cast<uint32_t>(subpatches.size() - index - 1);
}

// bake_subpatches(), or nothing if progress says stop.
std::optional<std::vector<SubpatchBounds>> subpatches_of(const BakedScene& scene,
                                                         const Progress& progress) {
  // Small chunks: a patch with nonsmooth subpatches takes some hundredths of a second.
  constexpr std::size_t size = 16;
  const ConeLimits& limits = scene.triangles.size() <= kFewPatches ? kLimitsOfFew : kLimitsOfMany;
  std::vector<std::vector<SubpatchBounds>> chunks(scene.triangles.size() / size + 1);
  const auto bound = [&](std::size_t first, std::size_t end) {
    std::vector<SubpatchBounds>& subpatches = chunks[first / size];
    subpatches.reserve(end - first);
    for (std::size_t t = first; t < end; ++t) {
      if (!has_surface(scene.triangles[t])) continue;
      bound_subpatch(patch_data(scene.choice, scene.triangles[t]), limits, kWholeTriangle, 0,
                     static_cast<uint32_t>(t), subpatches);
    }
  };
  if (!parallel_chunks(scene.triangles.size(), size, bound, progress)) return std::nullopt;
  std::vector<SubpatchBounds> subpatches;
  for (const std::vector<SubpatchBounds>& chunk : chunks) {
    subpatches.insert(subpatches.end(), chunk.begin(), chunk.end());
  }
  return subpatches;
}

}  // namespace

bool has_divided_patches(const BakedScene& scene) {
  return std::any_of(scene.subpatches.begin(), scene.subpatches.end(),
                     [](const SubpatchBounds& bounds) { return bounds.skip > 0; });
}

bool has_nonsmooth(const BakedScene& scene) {
  return std::any_of(scene.subpatches.begin(), scene.subpatches.end(),
                     [](const SubpatchBounds& bounds) {
                       return bounds.skip == 0 && bounds.gradient_lipschitz == NONSMOOTH;
                     });
}

std::vector<SubpatchBounds> bake_subpatches(const BakedScene& scene) {
  return *subpatches_of(scene, {});
}

BakedScene bake_with_subpatches(const Mesh& mesh, const SurfaceChoice& choice) {
  return *bake_with_subpatches(mesh, choice, {});
}

std::optional<BakedScene> bake_with_subpatches(const Mesh& mesh, const SurfaceChoice& choice,
                                               const Progress& progress) {
  BakedScene scene = bake(mesh, choice);
  auto subpatches = subpatches_of(scene, progress);
  if (!subpatches) return std::nullopt;
  scene.subpatches = *std::move(subpatches);
  return scene;
}

}  // namespace trisect
