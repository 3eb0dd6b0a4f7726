#include "app/bake/subpatch_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "app/bake/control_net.h"
#include "app/bake/enclosing_ball.h"
#include "app/base/max_propagating_nan.h"
#include "app/base/parallel_rows.h"
#include "app/base/rounding.h"
#include "app/surface/patch_range.h"
#include "app/surface/sphere_range.h"
#include "app/surface/surface_double.h"
#include "app/surface/surface_float.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec3;

// A cage's quadratic must follow sigma to this part of the longest edge of its part of the
// triangle, and its tangents S's to this part of it; else the part is divided, at most so many
// times. A part with a kink, whose tangents no quadratic follows, is divided further by the kernel,
// for the few rays that come near.
constexpr double kClose = 0.02;
constexpr double kTangentsClose = 0.1;
constexpr int kMostLevels = 6;
// Interval arithmetic is tighter over pieces of a part: 4^2 of them.
constexpr int kProofDivisions = 2;

// Rays are quick along the directions of a part's cone (SubpatchBounds::cone), whose w should be at
// most so large; else the part is divided, for this reason no further than to 4^2 parts of a patch.
constexpr float kWide = 0.3F;
constexpr int kLevelsForCones = 2;
const vec4 kNoCone(0.0F, 0.0F, 0.0F, NO_CONE);

// sigma is sampled at the weights with this denominator; between the samples it may stray further
// by this factor.
constexpr int kSamples = 12;
constexpr double kBetweenSamples = 1.5;

struct PatchData {
  in_double::Shape shape;
  in_double::Triangle tri;
  Corners corners;
  Patch ranges;      // for proofs
  glm::vec3 bulges;  // the kernels' edge_bulges
};

// A piece of a part, and the range of sigma over it, if D does not vanish.
struct RangedPiece {
  Part part;
  PartCorners corners;
  std::optional<Interval> sigma;
};

struct Fit {
  DisplacementQuadratic q;
  double position_error = 0.0;      // of S, a length
  double tangent_error = 0.0;       // of S_u and S_v
  double gradient_lipschitz = 0.0;  // SubpatchBounds::bend
  std::vector<RangedPiece> pieces;  // of a part that may have a kink, its overlap included
};

PatchData patch_of(const SurfaceChoice& choice, const Triangle& single) {
  const in_double::Triangle tri = to_double(single);
  return {shape_of(choice), tri, corners_of(tri, choice.shell), patch_of(choice.shell, single),
          in_float::edge_bulges(single, static_cast<float>(choice.alpha))};
}

// The quadratic with these values at the part's corners and at the middles of its edges.
template <typename Value>
DisplacementQuadratic through(const SubTriangle& part, Value&& value) {
  const auto at = [&](const dvec3& l) { return value(part.origin + l * part.size); };
  DisplacementQuadratic local;
  for (int k = 0; k < 3; ++k) local.corner[k] = at(corner_weights(k));
  for (int k = 0; k < 3; ++k) {
    const int i = k == 2 ? 0 : k;
    const int j = k == 2 ? 2 : k + 1;
    local.edge[k] = 2.0 * at((corner_weights(i) + corner_weights(j)) * 0.5) -
                    (local.corner[i] + local.corner[j]) * 0.5;
  }
  // In the weights of the whole: the blossom does not mind that the corners lie outside the part.
  const auto inside = [&](int k) { return (corner_weights(k) - part.origin) / part.size; };
  DisplacementQuadratic whole;
  for (int k = 0; k < 3; ++k) whole.corner[k] = local.blossom(inside(k), inside(k));
  whole.edge = {local.blossom(inside(0), inside(1)), local.blossom(inside(1), inside(2)),
                local.blossom(inside(0), inside(2))};
  return whole;
}

// sigma - q and its gradient.
struct Sample {
  dvec3 w;
  double e;
  glm::dvec2 gradient;
};

Sample sample(const PatchData& patch, const DisplacementQuadratic& q, const dvec3& w) {
  const in_double::Displacement sigma =
      in_double::displacement_and_derivatives(patch.shape, patch.tri, w);
  return {w,
          sigma.s - q.blossom(w, w),
          {sigma.u - 2.0 * q.blossom(w, {-1.0, 1.0, 0.0}),
           sigma.v - 2.0 * q.blossom(w, {-1.0, 0.0, 1.0})}};
}

std::vector<Sample> samples_of(const PatchData& patch, const SubTriangle& part,
                               const DisplacementQuadratic& q) {
  std::vector<Sample> samples;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; i + j <= kSamples; ++j) {
      const dvec3 l = dvec3(kSamples - i - j, i, j) / static_cast<double>(kSamples);
      samples.push_back(sample(patch, q, part.origin + l * part.size));
    }
  }
  return samples;
}

// The largest change of the gradient between neighbours of samples_of, those farther away having
// been seen in steps, over their distance in weights of the part.
double steepest_change(const std::vector<Sample>& samples) {
  double steepest = 0.0;
  // Row i begins where the shorter ones before it end.
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

// Raises `stray` to how far S_u and S_v are from the cage's at the sample.
void raise_tangent_error(const PatchData& patch, const Sample& a, double& position_error) {
  const dvec3 D = in_double::weigh(a.w, patch.corners.D[0], patch.corners.D[1], patch.corners.D[2]);
  max_propagating_nan(position_error, glm::length(D * a.gradient.x +
                                                  (patch.corners.D[1] - patch.corners.D[0]) * a.e));
  max_propagating_nan(position_error, glm::length(D * a.gradient.y +
                                                  (patch.corners.D[2] - patch.corners.D[0]) * a.e));
}

// Whether sigma may have a kink over a part, as far as so many divisions tell.
bool may_be_nonsmooth(const PatchData& patch, const Part& part, int divisions) {
  if (sphere_is_smooth(patch.ranges, part)) return false;
  if (divisions == 0) return true;
  const auto quarters = quarter(part);
  return std::any_of(quarters.begin(), quarters.end(), [&](const Part& piece) {
    return may_be_nonsmooth(patch, piece, divisions - 1);
  });
}

void add_pieces(const PatchData& patch, const Part& part, int divisions,
                std::vector<RangedPiece>& pieces) {
  if (divisions > 0) {
    for (const Part& piece : quarter(part)) add_pieces(patch, piece, divisions - 1, pieces);
    return;
  }
  const PartCorners corners = corners_of(patch.ranges, part);
  pieces.push_back({part, corners, sphere_sigma_range(patch.ranges, part, corners)});
}

// The most by which S strays from T + q D over a piece, proven.
double proven_position_error(const DisplacementQuadratic& q, const RangedPiece& piece) {
  if (!piece.sigma) return kInfinity;
  Interval quadratic = q.blossom(piece.part[0], piece.part[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    quadratic = hull(quadratic, q.blossom(piece.part[i], piece.part[i]));
    quadratic = hull(quadratic, q.blossom(piece.part[i], piece.part[(i + 1) % 3]));
  }
  const Interval e = *piece.sigma - quadratic;
  return std::max(-e.lo, e.hi) * longest_of(piece.corners.D);
}

// The quadratic of a part of the sphere surface that may have a kink.
Fit nonsmooth_fit(const PatchData& patch, const SubTriangle& part, Fit fit, double rounded) {
  constexpr double most = std::numeric_limits<float>::max();
  add_pieces(patch, corners_of(enlarged(part, OVERLAP)), kProofDivisions, fit.pieces);
  double position_error = 0.0;
  for (const RangedPiece& piece : fit.pieces)
    max_propagating_nan(position_error, proven_position_error(fit.q, piece));
  fit.position_error = std::isfinite(position_error) ? position_error + rounded : most;
  fit.tangent_error = most;
  fit.gradient_lipschitz = NONSMOOTH;
  return fit;
}

Fit fit(const PatchData& patch, const SubTriangle& part) {
  const bool cubic = in_double::is_cubic(patch.shape);
  Fit fit;
  // Of a cubic patch as the kernels have it from the triangle, to the bit.
  fit.q = cubic ? DisplacementQuadratic{dvec3(0.0), dvec3(patch.bulges) * 0.5}
                : through(part, [&](const dvec3& w) {
                    return in_double::displacement(patch.shape, patch.tri, w);
                  });
  const double longest_D = longest_of(patch.corners.D);
  // Rounding of the coefficients to single precision.
  constexpr double rounding = 2e-7;
  const dvec3 size = glm::max(glm::abs(fit.q.corner), glm::abs(fit.q.edge));
  const double rounded = rounding * std::max({size.x, size.y, size.z}) * longest_D;
  if (cubic) {
    fit.position_error = rounded;
    fit.tangent_error = rounded;
    return fit;
  }
  if (patch.shape.surface == SURFACE_SPHERE &&
      may_be_nonsmooth(patch, corners_of(enlarged(part, CONE_MARGIN)), kProofDivisions)) {
    return nonsmooth_fit(patch, part, fit, rounded);
  }
  const SubTriangle large = enlarged(part, OVERLAP);
  const std::vector<Sample> samples = samples_of(patch, large, fit.q);
  for (const Sample& a : samples) {
    const dvec3 D =
        in_double::weigh(a.w, patch.corners.D[0], patch.corners.D[1], patch.corners.D[2]);
    max_propagating_nan(fit.position_error, glm::length(D) * std::abs(a.e));
    raise_tangent_error(patch, a, fit.tangent_error);
  }
  max_propagating_nan(fit.gradient_lipschitz,
                      steepest_change(samples) / std::abs(large.size) * longest_D);
  const auto widened = [&](double position_error) {
    return std::isfinite(position_error) ? position_error * kBetweenSamples + rounded
                                         : static_cast<double>(std::numeric_limits<float>::max());
  };
  fit.position_error = widened(fit.position_error);
  fit.tangent_error = widened(fit.tangent_error);
  fit.gradient_lipschitz = widened(fit.gradient_lipschitz);
  return fit;
}

// The ball around a part, its overlap with the next ones included.
Ball part_ball(const PatchData& patch, const SubTriangle& part, const Fit& fit) {
  std::vector<Ball> points;
  // Around a part with a kink its pieces' corners displaced by the least and the largest sigma:
  // closer than the part's quadratic where directions are long.
  for (const auto& [piece, corners, sigma] : fit.pieces) {
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
    for (const dvec3& point : net_of(patch.corners, enlarged(part, OVERLAP), fit.q)) {
      points.push_back({point, fit.position_error});
    }
  }
  Ball ball = enclosing_ball(points);
  ball.radius += 1e-6 * (ball.radius + glm::length(ball.center));  // rounding to single precision
  return ball;
}

// The most by which a matrix lengthens a vector.
double norm_of(const glm::dmat2& m) {
  // Half the sum and half the difference of its singular values.
  return 0.5 * (std::hypot(m[0][0] + m[1][1], m[0][1] - m[1][0]) +
                std::hypot(m[0][0] - m[1][1], m[0][1] + m[1][0]));
}

// How far S_u and S_v stray over an enlarged part from those of its cage.
double tangents_error(const PatchData& patch, const SubTriangle& part, const Fit& fit) {
  if (fit.gradient_lipschitz == 0.0) return fit.tangent_error;
  double most = 0.0;
  for (const Sample& a : samples_of(patch, part, fit.q)) raise_tangent_error(patch, a, most);
  return std::max(kBetweenSamples * most, fit.tangent_error);
}

// SubpatchBounds::cone. S_u and S_v at a point are the same convex combination of the control
// vectors u_i and v_i; so is their mean along a line from one point to another, with which S
// differs between them. Seen along a direction d, on the tangent plane with normal n and mean
// tangents M0, that mean is M0 (1 + E - t g^T), t the tangent of the angle between d and n, E and g
// those of (u_i, v_i): it is one to one if |E| + t |g| < 1 for all i.
vec4 normal_cone(const PatchData& patch, const SubTriangle& part, const Fit& fit) {
  const SubTriangle large = enlarged(part, CONE_MARGIN);
  const ControlNet b = net_of(patch.corners, large, fit.q);
  const std::array<dvec3, 6> u{b[3] - b[0], b[1] - b[4], b[6] - b[7],
                               b[4] - b[3], b[9] - b[8], b[5] - b[9]};
  const std::array<dvec3, 6> v{b[8] - b[0], b[5] - b[4], b[2] - b[7],
                               b[9] - b[3], b[7] - b[8], b[6] - b[9]};
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
  const double position_error = tangents_error(patch, large, fit) * std::abs(large.size) / 3.0 *
                                std::sqrt(2.0) * norm_of(inverse);
  // The largest |g| / (1 - |E|): the cotangent of the smallest angle with n that is too large.
  double flattest = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::dmat2 change =
        glm::dmat2(in_plane(u[i]), in_plane(v[i])) * inverse - glm::dmat2(1.0);
    const double room = 1.0 - norm_of(change) - position_error;
    // Written so that a NaN has no cone.
    if (!(room > 0.0)) return kNoCone;
    const double gradient_lipschitz =
        glm::length(glm::dvec2(glm::dot(u[i], n), glm::dot(v[i], n)) * inverse) + position_error;
    max_propagating_nan(flattest, gradient_lipschitz / room);
  }
  constexpr double narrowest = 10.0;
  if (!(flattest < narrowest)) return kNoCone;
  // Of the ray's direction and the axis in single precision.
  constexpr double rounding = 1e-5;
  return {glm::vec3(n), static_cast<float>(flattest / std::hypot(flattest, 1.0) + rounding)};
}

SubpatchBounds bounds_of(const PatchData& patch, const SubTriangle& part, const Fit& fit,
                         uint32_t triangle) {
  SubpatchBounds bounds{};
  // That of the whole patch, and of a part whose bounds are none.
  bounds.ball = vec4(patch.tri.Domain);
  if (part.size < 1.0) {
    const Ball ball = part_ball(patch, part, fit);
    if (ball.radius < patch.tri.Domain.w) {
      bounds.ball = vec4(glm::vec3(ball.center), rounded_up(ball.radius));
    }
  }
  bounds.sub_triangle = vec4(glm::vec3(part.origin), static_cast<float>(part.size));
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
  // The kernel meets the patch's plane, whatever the part: only the whole may be it.
  bounds.is_flat = no_displacement && part.size == 1.0 ? 1 : 0;
  return bounds;
}

void bound_subpatch(const PatchData& patch, const SubTriangle& part, int level, uint32_t triangle,
                    std::vector<SubpatchBounds>& subpatches) {
  const Fit found = fit(patch, part);
  const double size = patch.tri.TriNormal.w * std::abs(part.size);
  const bool close = found.position_error <= kClose * size &&
                     found.tangent_error <= kTangentsClose * patch.tri.TriNormal.w;
  const std::size_t index = subpatches.size();
  subpatches.push_back(bounds_of(patch, part, found, triangle));
  const bool kinked = subpatches[index].gradient_lipschitz == NONSMOOTH;
  if (close || level == kMostLevels) {
    if (!kinked) subpatches[index].cone = normal_cone(patch, part, found);
    if (subpatches[index].cone.w <= kWide || level >= kLevelsForCones) return;
  }
  const double half = part.size * 0.5;
  for (int k = 0; k < 3; ++k) {
    bound_subpatch(patch, {part.origin + corner_weights(k) * half, half}, level + 1, triangle,
                   subpatches);
  }
  bound_subpatch(patch, {part.origin + dvec3(half), -half}, level + 1, triangle, subpatches);
  subpatches[index].skip = static_cast<uint32_t>(subpatches.size() - index - 1);
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
  // A patch with kinks takes some hundredths of a second.
  constexpr std::size_t size = 16;
  std::vector<std::vector<SubpatchBounds>> chunks(scene.triangles.size() / size + 1);
  parallel_chunks(scene.triangles.size(), size, [&](std::size_t first, std::size_t end) {
    std::vector<SubpatchBounds>& subpatches = chunks[first / size];
    subpatches.reserve(end - first);
    for (std::size_t t = first; t < end; ++t) {
      bound_subpatch(patch_of(scene.choice, scene.triangles[t]), {}, 0, static_cast<uint32_t>(t),
                     subpatches);
    }
  });
  std::vector<SubpatchBounds> subpatches;
  for (const std::vector<SubpatchBounds>& chunk : chunks) {
    subpatches.insert(subpatches.end(), chunk.begin(), chunk.end());
  }
  return subpatches;
}

BakedScene bake_with_subpatches(const Mesh& mesh, const SurfaceChoice& choice) {
  BakedScene scene = bake(mesh, choice);
  scene.subpatches = bake_subpatches(scene);
  return scene;
}

}  // namespace trisect
