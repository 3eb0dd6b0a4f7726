#include "app/surface/tangent_range.h"

#include <algorithm>
#include <cmath>

#include "app/base/rounding.h"
#include "app/surface/bernstein.h"
#include "app/surface/control_net.h"
#include "app/surface/sphere_range.h"

namespace trisect {
namespace {

using glm::dvec3;

// Relative to the sizes of what is added up: each figure comes of fewer than a hundred roundings.
constexpr double kSlack = gamma_double(900);

Interval grown(const Interval& a, double by) {
  return {a.lo - by, a.hi + by};
}

// From the least to the most of some coefficients, with a slack for what each is made of. Unbounded
// if one of them is not finite.
template <std::size_t count>
Interval range_of(const std::array<double, count>& values, double slack) {
  double lo = kInfinity;
  double hi = -kInfinity;
  for (const double value : values) {
    if (!std::isfinite(value)) return {-kInfinity, kInfinity};
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  return grown({lo, hi}, slack);
}

template <std::size_t count>
Interval range_along(const std::array<dvec3, count>& vectors, const dvec3& axis, double slack) {
  std::array<double, count> values{};
  for (std::size_t i = 0; i < count; ++i) values[i] = glm::dot(vectors[i], axis);
  return range_of(values, slack);
}

bool is_finite(const TangentRanges& ranges) {
  const auto finite = [](const Interval& a) { return std::isfinite(a.lo) && std::isfinite(a.hi); };
  return std::all_of(ranges.u.begin(), ranges.u.end(), finite) &&
         std::all_of(ranges.v.begin(), ranges.v.end(), finite);
}

// S_u = dT + D sigma_u + dD sigma, the derivatives by the weights of the patch, times the
// sub-triangle's size.
TangentRanges from_sigma(const Patch& patch, const in_double::SubTriangle& sub_triangle,
                         const CornerWeights& weights, const PatchCorners& corners,
                         const SigmaRanges& sigma, const std::array<dvec3, 3>& axes) {
  const double size = sub_triangle.size;
  // Directions may cancel, their roundings do not.
  const double widest = longest_of(patch.D) * largest_weights(weights);
  const auto along = [&](std::size_t vertex, const Interval& slope, const dvec3& axis) {
    const dvec3 dT = patch.P[vertex] - patch.P[0];
    const dvec3 dD = patch.D[vertex] - patch.D[0];
    const double sizes = glm::length(dT) + widest * magnitude(slope) +
                         longest_of(patch.D) * 2.0 * magnitude(sigma.s);
    const Interval change = glm::dot(dT, axis) + range_along(corners.D, axis, 0.0) * slope +
                            glm::dot(dD, axis) * sigma.s;
    return grown(change, kSlack * sizes * glm::length(axis)) * size;
  };
  TangentRanges ranges;
  for (std::size_t k = 0; k < 3; ++k) {
    ranges.u[k] = along(1, sigma.u, axes[k]);
    ranges.v[k] = along(2, sigma.v, axes[k]);
  }
  return ranges;
}

TangentRanges of_cubic(const Patch& patch, double alpha, const in_double::SubTriangle& sub_triangle,
                       const PatchCorners& corners, const std::array<dvec3, 3>& axes) {
  const TangentNet net = tangent_net(patch, phong_quadratic(patch, alpha), sub_triangle);
  // The control vectors are differences of points.
  const double sizes = longest_of(corners.T) + (1.0 + std::abs(alpha)) * patch.longest * 4.0;
  TangentRanges ranges;
  for (std::size_t k = 0; k < 3; ++k) {
    const double slack = kSlack * sizes * glm::length(axes[k]);
    ranges.u[k] = range_along(net.u, axes[k], slack) * 3.0;
    ranges.v[k] = range_along(net.v, axes[k], slack) * 3.0;
  }
  return ranges;
}

// Ranges of phong's sigma in the height shell and of its derivatives by the weights of the patch:
// sigma = alpha D.K / |D|^2, sigma' = alpha (D'.K + D.K' - 2 (D.K) (D.D') / |D|^2) / |D|^2.
std::optional<SigmaRanges> height_shell_ranges(const Patch& patch, double alpha,
                                               const CornerWeights& weights,
                                               const PatchCorners& corners) {
  const Interval DD = direction_square_range(patch, weights, corners);
  if (!(DD.lo > 0.0)) return std::nullopt;
  const auto& D = corners.D;
  const std::array<dvec3, 3> products = phong_offset_products(patch);
  const Quadratic<dvec3> K = quadratic_over(weights, products);
  const auto dot = [](const dvec3& a, const dvec3& b) { return glm::dot(a, b); };
  // Every vector of K is a sum of products as long as an edge, with weights of at most a few.
  const double weight = largest_weights(weights);
  const double K_size = 2.0 * patch.longest * weight * weight;
  const double D_size = longest_of(patch.D) * weight;
  const Interval DK = range_of(cubic_of(K, D, dot), kSlack * K_size * D_size);
  SigmaRanges sigma;
  sigma.s = divide_by_positive(DK * alpha, DD);
  const auto derivative = [&](const dvec3& direction, std::size_t vertex) {
    const dvec3 dD = patch.D[vertex] - patch.D[0];
    std::array<dvec3, 3> dK{};
    for (std::size_t k = 0; k < 3; ++k) {
      dK[k] = blossom_of(products, weights[k], direction) * 2.0;
    }
    const double slack = kSlack * 4.0 * K_size * D_size;
    const Interval dD_K = range_along(K, dD, slack);
    const Interval D_dK = range_of(quadratic_of(D, dK, dot), slack);
    const Interval D_dD = range_along(D, dD, kSlack * 2.0 * D_size * D_size);
    const Interval turned = divide_by_positive(DK * D_dD * 2.0, DD);
    return divide_by_positive((dD_K + D_dK - turned) * alpha, DD);
  };
  sigma.u = derivative({-1.0, 1.0, 0.0}, 1);
  sigma.v = derivative({-1.0, 0.0, 1.0}, 2);
  return sigma;
}

}  // namespace

std::optional<TangentRanges> tangent_ranges(const SurfaceChoice& choice, const Patch& patch,
                                            const in_double::SubTriangle& sub_triangle,
                                            const std::array<dvec3, 3>& axes) {
  const CornerWeights weights = corner_weights(sub_triangle);
  const PatchCorners corners = corners_of(patch, weights);
  std::optional<SigmaRanges> sigma;
  if (choice.surface == SURFACE_FLAT) {
    sigma = SigmaRanges{};
  } else if (choice.surface == SURFACE_SPHERE) {
    sigma = sphere_change_ranges(patch, weights, corners);
  } else if (choice.shell == SHELL_HEIGHT) {
    sigma = height_shell_ranges(patch, choice.alpha, weights, corners);
  }
  const bool is_cubic = choice.surface == SURFACE_PHONG && choice.shell == SHELL_NORMAL;
  if (!is_cubic && !sigma) return std::nullopt;
  const TangentRanges ranges =
      is_cubic ? of_cubic(patch, choice.alpha, sub_triangle, corners, axes)
               : from_sigma(patch, sub_triangle, weights, corners, *sigma, axes);
  if (!is_finite(ranges)) return std::nullopt;
  return ranges;
}

}  // namespace trisect
