#include "app/surface/sphere_range.h"

#include <algorithm>
#include <cmath>

#include "app/base/rounding.h"
#include "app/surface/surface_double.h"

namespace trisect {
namespace {

using glm::dvec3;
using in_double::HeightRange;

// The corners of a sub-triangle, with the rounding of their weighted sums: three of it, on the way
// of each vertex or direction into a corner, and one more where another vertex is subtracted.
in_double::Corners corners_with_error(const CornerWeights& weights,
                                      const std::array<dvec3, 3>& vectors,
                                      const std::array<dvec3, 3>& at_corners) {
  double sum = 0.0;
  for (const dvec3& w : weights) {
    sum = std::max(sum, std::abs(w.x) + std::abs(w.y) + std::abs(w.z));
  }
  return {at_corners[0], at_corners[1], at_corners[2], gamma_double(4) * sum * longest_of(vectors)};
}

// What the ranges of sigma over a sub-triangle are made from.
struct SphereOverSubTriangle {
  in_double::Corners T;
  in_double::Corners D;
  Interval DD;
  std::array<Interval, 3> w;
};

SphereOverSubTriangle sphere_over(const Patch& patch, const CornerWeights& weights,
                                  const PatchCorners& corners) {
  SphereOverSubTriangle over{};
  over.T = corners_with_error(weights, patch.P, corners.T);
  over.D = corners_with_error(weights, patch.D, corners.D);
  over.DD = in_double::square_range(over.D, patch.n);
  for (int i = 0; i < 3; ++i) {
    const auto [lo, hi] = std::minmax({weights[0][i], weights[1][i], weights[2][i]});
    over.w[static_cast<std::size_t>(i)] = {lo, hi};
  }
  return over;
}

HeightRange height_range(const Patch& patch, std::size_t i, const SphereOverSubTriangle& over) {
  return in_double::height_range(patch.triangle, static_cast<int>(i), over.T, over.D, over.DD);
}

// Whether the directions do not vanish. Written so that a NaN is no direction.
bool has_directions(const SphereOverSubTriangle& over) {
  return over.DD.lo > in_double::LEAST_DIRECTION_SQUARE;
}

// Whether A and B do not both vanish somewhere, for all that the ranges tell.
bool has_root(const HeightRange& h) {
  return in_double::range_magnitude(h.s) < in_double::UNBOUNDED;
}

// Whether the limit is a smooth function of D over a sub-triangle.
bool limit_is_smooth(const HeightRange& h) {
  const Interval flat = root(h.DD) * in_double::FLAT_SINE;
  return h.DN.hi < 0.0 || h.DN.lo > flat.hi || (h.DN.lo > 0.0 && h.DN.hi < flat.lo);
}

// Whether the root stays within its limit all over a sub-triangle.
bool is_within_limit(const Patch& patch, std::size_t i, const HeightRange& h) {
  if (h.s.hi < h.limit.lo && h.s.lo > -h.limit.lo) return true;
  if (!(h.B.lo > 0.0) || !(h.discriminant.lo > 0.0)) return false;
  // Next to the vertex both fall to 0. Compare what they are to the distance x from it:
  // |s| <= (|c| x + 2 |x.N| / x) x / (B + root), where x.N / x is at most the length of N along the
  // face.
  const double along = glm::length(patch.N[i] - patch.n * glm::dot(patch.N[i], patch.n));
  // N and n are unit vectors, and n, a cross product, is off by 8 roundings over the sine between
  // two edges.
  const dvec3 E1 = patch.P[1] - patch.P[0];
  const dvec3 E2 = patch.P[2] - patch.P[0];
  const double sine = glm::length(glm::cross(E1, E2)) / (glm::length(E1) * glm::length(E2));
  const double most_along = along + gamma_double(16) + gamma_double(16) / sine;
  const Interval slope = divide_by_positive(
      Interval(in_double::range_magnitude(h.c)) * root(h.xx) + 2.0 * most_along, h.B + h.root);
  const Interval D = root(h.DD);
  const double least_sine = std::min(divide_by_positive(h.DN, D * in_double::FLAT_SINE).lo, 1.0);
  return slope.hi < divide_by_positive(least_sine, D).lo;
}

// Whether s_i is smooth over a sub-triangle: it is the limit all over it, or nowhere, and then all
// of the lines meet the sphere or none.
bool is_smooth(const Patch& patch, std::size_t i, const HeightRange& h) {
  if (h.DN.hi < 0.0) return true;
  if (!has_root(h)) return false;
  if (h.s.lo > h.limit.hi || h.s.hi < -h.limit.hi) return limit_is_smooth(h);
  return (h.discriminant.lo > 0.0 || h.discriminant.hi < 0.0) && is_within_limit(patch, i, h);
}

// Whether s_i is the root all over a sub-triangle and has bounded derivatives there.
bool is_root_with_derivatives(const Patch& patch, std::size_t i, const HeightRange& h) {
  return has_root(h) && h.xx.lo > 0.0 && patch.data[i].z > 0.0 && h.discriminant.lo > 0.0 &&
         h.s.hi < h.limit.lo && h.s.lo > -h.limit.lo;
}

}  // namespace

Interval direction_square_range(const Patch& patch, const CornerWeights& weights,
                                const PatchCorners& corners) {
  return in_double::square_range(corners_with_error(weights, patch.D, corners.D), patch.n);
}

std::optional<Interval> sphere_sigma_range(const Patch& patch, const CornerWeights& weights,
                                           const PatchCorners& corners) {
  const SphereOverSubTriangle over = sphere_over(patch, weights, corners);
  if (!has_directions(over)) return std::nullopt;
  Interval sigma(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    sigma = sigma + over.w[i] * height_range(patch, i, over).held;
  }
  return sigma;
}

bool sphere_is_smooth(const Patch& patch, const CornerWeights& weights) {
  const SphereOverSubTriangle over = sphere_over(patch, weights, corners_of(patch, weights));
  if (!has_directions(over)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!is_smooth(patch, i, height_range(patch, i, over))) return false;
  }
  return true;
}

std::optional<SigmaRanges> sphere_derivative_ranges(const Patch& patch,
                                                    const CornerWeights& weights,
                                                    const PatchCorners& corners) {
  const SphereOverSubTriangle over = sphere_over(patch, weights, corners);
  if (!has_directions(over)) return std::nullopt;
  const auto& P = patch.P;
  const auto& D = patch.D;
  in_double::SphereRange sigma{0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const HeightRange h = height_range(patch, i, over);
    if (!is_root_with_derivatives(patch, i, h)) return std::nullopt;
    in_double::add_height(sigma, static_cast<int>(i), h, over.w[i], P[1] - P[0], P[2] - P[0],
                          D[1] - D[0], D[2] - D[0]);
  }
  return SigmaRanges{sigma.s, sigma.u, sigma.v};
}

}  // namespace trisect
