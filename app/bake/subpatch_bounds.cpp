#include "app/bake/subpatch_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "app/bake/enclosing_ball.h"
#include "app/bake/patch_bounds.h"
#include "app/base/max_propagating_nan.h"
#include "app/base/parallel_rows.h"
#include "app/base/rounding.h"
#include "app/surface/control_net.h"
#include "app/surface/patch_range.h"
#include "app/surface/sphere_range.h"
#include "app/surface/surface_double.h"
#include "app/surface/surface_float.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec3;

using in_double::SubTriangle;

// The quadratic of a subpatch must follow the surface to this part of the longest edge of the
// sub-triangle, and the tangents to this part of the longest edge of the patch; otherwise the
// subpatch is divided, at most so many times. One that may be nonsmooth, whose tangents no
// quadratic follows, is divided further by the kernel, for the few rays that come near.
constexpr double kClose = 0.02;
constexpr double kTangentsClose = 0.1;
constexpr int kMostLevels = 6;
// Interval arithmetic is tighter over small pieces: a subpatch is examined in 4^2 of them.
constexpr int kProofDivisions = 2;

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

// sigma is sampled at the weights with this denominator, 91 points. What the samples show is
// multiplied by kBetweenSamples for the points between them, which is a margin and no proof.
constexpr int kSamples = 12;
constexpr double kBetweenSamples = 1.5;

struct PatchData {
  in_double::Shape shape;
  in_double::Triangle tri;
  Patch corners;
  glm::vec3 bulges;  // edge_bulges in single precision, as the kernels see them
};

// A piece of a subpatch, and the range of sigma over it, if one is known.
struct RangedPiece {
  CornerWeights weights;
  PatchCorners corners;
  std::optional<Interval> sigma;
};

struct Fit {
  DisplacementQuadratic q;
  double position_error = 0.0;      // S is no farther from T + q D, a length
  double tangent_error = 0.0;       // S_u and S_v are no farther from those of T + q D
  double gradient_lipschitz = 0.0;  // SubpatchBounds::gradient_lipschitz
  std::vector<RangedPiece> pieces;  // of a subpatch that may be nonsmooth, its overlap included
};

PatchData patch_data(const SurfaceChoice& choice, const Triangle& single) {
  return {shape_of(choice), to_double(single), patch_of(choice.shell, single),
          in_float::edge_bulges(single, static_cast<float>(choice.alpha))};
}

dvec3 vertex_weights(int k) {
  dvec3 e(0.0);
  e[k] = 1.0;
  return e;
}

// The quadratic with these values at the corners of a sub-triangle and at the midpoints of its
// edges.
template <typename Value>
DisplacementQuadratic through(const SubTriangle& sub_triangle, Value&& value) {
  const auto at = [&](const dvec3& l) { return value(in_double::weights_of(sub_triangle, l)); };
  DisplacementQuadratic local;
  for (int k = 0; k < 3; ++k) local.corner[k] = at(vertex_weights(k));
  for (int k = 0; k < 3; ++k) {
    const int i = k == 2 ? 0 : k;
    const int j = k == 2 ? 2 : k + 1;
    local.edge[k] = 2.0 * at((vertex_weights(i) + vertex_weights(j)) * 0.5) -
                    (local.corner[i] + local.corner[j]) * 0.5;
  }
  // Over the whole triangle: its vertices may lie outside the sub-triangle, a blossom has values
  // there, too.
  const auto inside = [&](int k) { return in_double::weights_in(sub_triangle, vertex_weights(k)); };
  DisplacementQuadratic whole;
  for (int k = 0; k < 3; ++k) whole.corner[k] = local.blossom(inside(k), inside(k));
  whole.edge = {local.blossom(inside(0), inside(1)), local.blossom(inside(1), inside(2)),
                local.blossom(inside(0), inside(2))};
  return whole;
}

struct Sample {
  dvec3 w;
  double e;             // sigma - q
  glm::dvec2 gradient;  // of e, by the weights 1 and 2
};

Sample sample(const PatchData& patch, const DisplacementQuadratic& q, const dvec3& w) {
  const in_double::Displacement sigma =
      in_double::displacement_and_derivatives(patch.shape, patch.tri, w);
  return {w,
          sigma.s - q.blossom(w, w),
          {sigma.u - 2.0 * q.blossom(w, {-1.0, 1.0, 0.0}),
           sigma.v - 2.0 * q.blossom(w, {-1.0, 0.0, 1.0})}};
}

std::vector<Sample> samples_of(const PatchData& patch, const SubTriangle& sub_triangle,
                               const DisplacementQuadratic& q) {
  std::vector<Sample> samples;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; i + j <= kSamples; ++j) {
      const dvec3 l = dvec3(kSamples - i - j, i, j) / static_cast<double>(kSamples);
      samples.push_back(sample(patch, q, in_double::weights_of(sub_triangle, l)));
    }
  }
  return samples;
}

// The largest change of the gradient between neighbours of samples_of, over their distance in
// weights within the sub-triangle. Between samples farther apart the gradient changes in such
// steps.
double steepest_change(const std::vector<Sample>& samples) {
  double steepest = 0.0;
  // The rows are stored one after the other; row i has kSamples + 1 - i samples.
  const auto at = [&](int i, int j) -> const Sample& {
    const int row = i * (kSamples + 1) - i * (i - 1) / 2;
    return samples[static_cast<std::size_t>(row) + static_cast<std::size_t>(j)];
  };
  constexpr std::array<glm::ivec2, 4> steps{glm::ivec2(1, 0), {0, 1}, {1, -1}, {1, 1}};
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; i + j <= kSamples; ++j) {
      for (const glm::ivec2& step : steps) {
        const int k = i + step.x;
        const int l = j + step.y;
        if (l < 0 || k + l > kSamples) continue;
        max_propagating_nan(steepest, glm::distance(at(i, j).gradient, at(k, l).gradient) *
                                          kSamples / glm::length(glm::dvec2(step)));
      }
    }
  }
  return steepest;
}

// Raises tangent_error to the distance of S_u and S_v at the sample from those of T + q D.
void raise_tangent_error(const PatchData& patch, const Sample& a, double& tangent_error) {
  const auto& D = patch.corners.D;
  const dvec3 at = weigh(a.w, D);
  max_propagating_nan(tangent_error, glm::length(at * a.gradient.x + (D[1] - D[0]) * a.e));
  max_propagating_nan(tangent_error, glm::length(at * a.gradient.y + (D[2] - D[0]) * a.e));
}

// Whether sigma may be nonsmooth over a sub-triangle, as far as so many divisions tell.
bool may_be_nonsmooth(const PatchData& patch, const SubTriangle& sub_triangle, int divisions) {
  if (sphere_is_smooth(patch.corners, corner_weights(sub_triangle))) return false;
  if (divisions == 0) return true;
  const auto quarters = quarter(sub_triangle);
  return std::any_of(quarters.begin(), quarters.end(), [&](const SubTriangle& piece) {
    return may_be_nonsmooth(patch, piece, divisions - 1);
  });
}

void add_pieces(const PatchData& patch, const SubTriangle& sub_triangle, int divisions,
                std::vector<RangedPiece>& pieces) {
  if (divisions > 0) {
    for (const SubTriangle& piece : quarter(sub_triangle)) {
      add_pieces(patch, piece, divisions - 1, pieces);
    }
    return;
  }
  const CornerWeights weights = corner_weights(sub_triangle);
  const PatchCorners corners = corners_of(patch.corners, weights);
  pieces.push_back({weights, corners, sphere_sigma_range(patch.corners, weights, corners)});
}

// A proven bound on the distance of S from T + q D over a piece: the ranges of sigma and of q, from
// its Bernstein coefficients, give that of sigma - q.
double proven_position_error(const DisplacementQuadratic& q, const RangedPiece& piece) {
  if (!piece.sigma) return kInfinity;
  const CornerWeights& w = piece.weights;
  Interval quadratic = q.blossom(w[0], w[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    quadratic = hull(quadratic, q.blossom(w[i], w[i]));
    quadratic = hull(quadratic, q.blossom(w[i], w[(i + 1) % 3]));
  }
  const Interval e = *piece.sigma - quadratic;
  return std::max(-e.lo, e.hi) * longest_of(piece.corners.D);
}

// An error bound, or UNBOUNDED if nothing is known: if it is a NaN or infinite.
double known_error(double error) {
  return error < in_double::UNBOUNDED ? error : in_double::UNBOUNDED;
}

// The fit for a subpatch of the sphere surface that may be nonsmooth: only the position error is
// bounded. `rounded`: the position error from rounding the quadratic.
Fit nonsmooth_fit(const PatchData& patch, const SubTriangle& sub_triangle, Fit fit,
                  double rounded) {
  add_pieces(patch, in_double::with_overlap(sub_triangle), kProofDivisions, fit.pieces);
  double position_error = 0.0;
  for (const RangedPiece& piece : fit.pieces) {
    max_propagating_nan(position_error, proven_position_error(fit.q, piece));
  }
  fit.position_error = known_error(position_error + rounded);
  fit.tangent_error = in_double::UNBOUNDED;
  fit.gradient_lipschitz = NONSMOOTH;
  return fit;
}

Fit fit(const PatchData& patch, const SubTriangle& sub_triangle) {
  const bool cubic = in_double::is_cubic(patch.shape);
  Fit fit;
  // A cubic patch has its sigma for quadratic, with the coefficients that the kernels compute.
  fit.q = cubic ? DisplacementQuadratic{dvec3(0.0), dvec3(patch.bulges) * 0.5}
                : through(sub_triangle, [&](const dvec3& w) {
                    return in_double::displacement(patch.shape, patch.tri, w);
                  });
  // Where directions cancel out there is no sigma for a quadratic to follow. The errors tell.
  // Written so that a NaN is no coefficient.
  const double square = glm::dot(fit.q.corner, fit.q.corner) + glm::dot(fit.q.edge, fit.q.edge);
  const double most = 0.1 * static_cast<double>(LARGEST);
  if (!(square < most * most)) fit.q = DisplacementQuadratic{};
  const double longest_D = longest_of(patch.corners.D);
  // A coefficient is rounded to single precision, and a product with two weights rounds twice. The
  // kernels' certificates depend on it, and with them a root's last digits.
  constexpr double rounding = 2e-7;
  static_assert(rounding >= gamma_single(3));
  const dvec3 size = glm::max(glm::abs(fit.q.corner), glm::abs(fit.q.edge));
  const double rounded = rounding * std::max({size.x, size.y, size.z}) * longest_D;
  if (cubic) {
    fit.position_error = rounded;
    fit.tangent_error = rounded;
    return fit;
  }
  if (patch.shape.surface == SURFACE_SPHERE &&
      may_be_nonsmooth(patch, in_double::enlarged(sub_triangle, CONE_MARGIN), kProofDivisions)) {
    return nonsmooth_fit(patch, sub_triangle, fit, rounded);
  }
  const SubTriangle large = in_double::with_overlap(sub_triangle);
  const std::vector<Sample> samples = samples_of(patch, large, fit.q);
  for (const Sample& a : samples) {
    const double D = glm::length(weigh(a.w, patch.corners.D));
    max_propagating_nan(fit.position_error, D * std::abs(a.e));
    raise_tangent_error(patch, a, fit.tangent_error);
  }
  max_propagating_nan(fit.gradient_lipschitz,
                      steepest_change(samples) / std::abs(large.size) * longest_D);
  const auto widened = [&](double error) { return known_error(error * kBetweenSamples + rounded); };
  fit.position_error = widened(fit.position_error);
  fit.tangent_error = widened(fit.tangent_error);
  fit.gradient_lipschitz = widened(fit.gradient_lipschitz);
  return fit;
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

// Fit::tangent_error for an enlarged sub-triangle.
double tangent_error_over(const PatchData& patch, const SubTriangle& large, const Fit& fit) {
  if (fit.gradient_lipschitz == 0.0) return fit.tangent_error;
  double most = 0.0;
  for (const Sample& a : samples_of(patch, large, fit.q)) raise_tangent_error(patch, a, most);
  return std::max(kBetweenSamples * most, fit.tangent_error);
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

// Appends the bounds of a sub-triangle and, if it is divided, those of its children after it.
void bound_subpatch(const PatchData& patch, const ConeLimits& limits,
                    const SubTriangle& sub_triangle, int level, uint32_t triangle,
                    std::vector<SubpatchBounds>& subpatches) {
  const Fit found = fit(patch, sub_triangle);
  const double size = patch.tri.TriNormal.w * std::abs(sub_triangle.size);
  const bool close = found.position_error <= kClose * size &&
                     found.tangent_error <= kTangentsClose * patch.tri.TriNormal.w;
  const std::size_t index = subpatches.size();
  subpatches.push_back(bounds_of(patch, sub_triangle, found, triangle));
  const bool nonsmooth = subpatches[index].gradient_lipschitz == NONSMOOTH;
  if (close || level == kMostLevels) {
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
