#include "app/surface/patch_range.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "app/base/rounding.h"
#include "app/surface/bernstein.h"
#include "app/surface/control_net.h"
#include "app/surface/sphere_range.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec3;

// Relative. Every figure below comes of fewer than a hundred roundings of numbers no larger than
// the magnitude that this is multiplied with. The rest is for points of the surface evaluated in
// double precision, whose roundings grow where sigma is steep.
constexpr double kRounding = gamma_double(900);

// The flat sub-triangle with a ball of `radius` about each of its points.
Enclosure around_base(const PatchCorners& corners, double radius) {
  Enclosure e{};
  std::copy(corners.T.begin(), corners.T.end(), e.points.begin());
  e.count = 3;
  e.radius = radius + kRounding * longest_of(corners.T);
  return e;
}

Enclosure enclose_cubic(const Patch& patch, const in_double::SubTriangle& sub_triangle,
                        const PatchCorners& corners, double alpha) {
  Enclosure e{};
  e.count = 10;
  e.points = control_points(patch, phong_quadratic(patch, alpha), sub_triangle);
  // A coefficient of the quadratic is a difference of products as long as an edge.
  e.radius = kRounding * (longest_of(corners.T) + (1.0 + std::abs(alpha)) * patch.longest * 4.0);
  return e;
}

Enclosure enclose_quotient(const Patch& patch, const CornerWeights& weights,
                           const PatchCorners& corners, double alpha) {
  const auto& [T, D] = corners;
  const Quadratic<dvec3> K = quadratic_over(weights, phong_offset_products(patch));
  double farthest = 0.0;
  for (const dvec3& k : K) farthest = std::max(farthest, std::abs(alpha) * glm::length(k));
  const Enclosure wide =
      around_base(corners, farthest + kRounding * std::abs(alpha) * patch.longest * 4.0);
  const Quadratic<double> lengths{glm::dot(D[0], D[0]), glm::dot(D[1], D[1]), glm::dot(D[2], D[2]),
                                  glm::dot(D[0], D[1]), glm::dot(D[1], D[2]), glm::dot(D[2], D[0])};
  const double least = direction_square_range(patch, weights, corners).lo;
  if (!(least > 0.0)) return wide;

  std::array<double, 3> L{};
  for (std::size_t k = 0; k < 3; ++k) L[k] = alpha * glm::dot(D[k], K[k]) / lengths[k];
  const auto numerator =
      cubic_of(K, D, [alpha](const dvec3& k, const dvec3& d) { return alpha * glm::dot(k, d); });
  const auto chord = cubic_of(lengths, L, [](double q, double l) { return q * l; });
  double lo = kInfinity;
  double hi = -kInfinity;
  double magnitude = 0.0;
  for (std::size_t k = 0; k < 10; ++k) {
    lo = std::min(lo, numerator[k] - chord[k]);
    hi = std::max(hi, numerator[k] - chord[k]);
    magnitude = std::max(magnitude, std::abs(numerator[k]) + std::abs(chord[k]));
  }
  const double widest = longest_of(D);
  magnitude += std::abs(alpha) * patch.longest * 4.0 * widest;
  Enclosure e{};
  // The residue vanishes at the corners, so lo <= 0 <= hi.
  e.sigma = {std::min(0.0, lo - kRounding * magnitude) / least,
             std::max(0.0, hi + kRounding * magnitude) / least};
  if (!((e.sigma.hi - e.sigma.lo) * widest < farthest)) return wide;
  e.D = D;
  e.count = 6;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    e.points[i] = T[i] + D[i] * L[i];
    e.points[i + 3] = (T[i] + T[j] + D[i] * L[j] + D[j] * L[i]) * 0.5;
  }
  const double chord_displacement =
      widest * std::max({std::abs(L[0]), std::abs(L[1]), std::abs(L[2])});
  e.radius = kRounding * (longest_of(T) + chord_displacement + magnitude / least * widest);
  return e;
}

Enclosure enclose_sphere(const Patch& patch, const CornerWeights& weights,
                         const PatchCorners& corners) {
  // |s_i D| is at most HIGHEST times the distance of T from P_i, T - P_i = sum w_j (P_j - P_i), and
  // with m = sum |w_i| the sum of |w_i| |w_j| over i != j is at most 2/3 m^2.
  const double m = largest_weights(weights);
  const double farthest = in_double::HIGHEST * patch.longest * m * m * (2.0 / 3.0);
  const Enclosure wide = around_base(corners, farthest * (1.0 + kRounding));
  const auto sigma = sphere_sigma_range(patch, weights, corners);
  if (!sigma || !std::isfinite(sigma->lo) || !std::isfinite(sigma->hi)) return wide;
  Enclosure e = around_base(corners, 0.0);
  e.D = corners.D;
  e.sigma = *sigma;
  const double widest = longest_of(corners.D) * std::max(std::abs(sigma->lo), std::abs(sigma->hi));
  e.radius += kRounding * (widest + patch.longest);
  return e;
}

Enclosure enclose_surface(const SurfaceChoice& choice, const Patch& patch,
                          const in_double::SubTriangle& sub_triangle) {
  const CornerWeights weights = corner_weights(sub_triangle);
  const PatchCorners corners = corners_of(patch, weights);
  if (choice.surface == SURFACE_FLAT) return around_base(corners, 0.0);
  if (choice.surface == SURFACE_SPHERE) return enclose_sphere(patch, weights, corners);
  return choice.shell == SHELL_NORMAL ? enclose_cubic(patch, sub_triangle, corners, choice.alpha)
                                      : enclose_quotient(patch, weights, corners, choice.alpha);
}

}  // namespace

std::array<dvec3, 3> phong_offset_products(const Patch& patch) {
  std::array<dvec3, 3> V{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const dvec3 edge = patch.P[j] - patch.P[i];
    V[i] = patch.N[j] * glm::dot(edge, patch.N[j]) - patch.N[i] * glm::dot(edge, patch.N[i]);
  }
  return V;
}

Patch patch_of(uint shell, const Triangle& tri) {
  Patch patch{};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    patch.P[k] = dvec3(tri.Position[i]);
    patch.N[k] = dvec3(tri.Normal[i]);
    patch.D[k] =
        shell == SHELL_HEIGHT ? patch.N[k] / static_cast<double>(tri.NormDot[i]) : patch.N[k];
    patch.data[k] = dvec3(tri.VertexData[i]);
  }
  const dvec3 n = glm::cross(patch.P[1] - patch.P[0], patch.P[2] - patch.P[0]);
  patch.n = n == dvec3(0.0) ? dvec3(tri.TriNormal) : glm::normalize(n);
  patch.longest = static_cast<double>(tri.TriNormal.w);
  patch.triangle = to_double(tri);
  patch.triangle.TriNormal = glm::dvec4(patch.n, patch.longest);
  return patch;
}

std::array<in_double::SubTriangle, 4> quarter(const in_double::SubTriangle& sub_triangle) {
  return {in_double::child(sub_triangle, 0), in_double::child(sub_triangle, 1),
          in_double::child(sub_triangle, 2), in_double::child(sub_triangle, 3)};
}

CornerWeights corner_weights(const in_double::SubTriangle& sub_triangle) {
  return {in_double::weights_of(sub_triangle, {1.0, 0.0, 0.0}),
          in_double::weights_of(sub_triangle, {0.0, 1.0, 0.0}),
          in_double::weights_of(sub_triangle, {0.0, 0.0, 1.0})};
}

double largest_weights(const CornerWeights& weights) {
  double largest = 0.0;
  for (const dvec3& w : weights) {
    largest = std::max(largest, std::abs(w.x) + std::abs(w.y) + std::abs(w.z));
  }
  return largest;
}

PatchCorners corners_of(const Patch& patch, const CornerWeights& weights) {
  PatchCorners corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    corners.T[k] = weigh(weights[k], patch.P);
    corners.D[k] = weigh(weights[k], patch.D);
  }
  return corners;
}

Enclosure enclose(const SurfaceChoice& choice, const Patch& patch,
                  const in_double::SubTriangle& sub_triangle) {
  Enclosure e = enclose_surface(choice, patch, sub_triangle);
  bool finite = std::isfinite(e.sigma.lo) && std::isfinite(e.sigma.hi) && std::isfinite(e.radius);
  for (std::size_t k = 0; k < e.count; ++k) {
    finite = finite && std::isfinite(glm::dot(e.points[k], e.points[k]));
  }
  for (const dvec3& D : e.D) finite = finite && std::isfinite(glm::dot(D, D));
  // An overflow bounds nothing: a comparison with it must not say that the surface is elsewhere.
  if (!finite) {
    e = Enclosure{};
    e.count = 1;
    e.radius = kInfinity;
  }
  return e;
}

double largest_of_products(double a, double b, double c) {
  // The largest last: then nothing cancels below.
  if (a > c) std::swap(a, c);
  if (b > c) std::swap(b, c);
  const double on_edge = 0.25 * c;
  // Where the maximum is inside, the gradient's three components there are equal.
  if (!(a + b > c)) return on_edge;
  return std::max(on_edge, a * b * c / (4.0 * a * b - (a + (b - c)) * (a + (b - c))));
}

Interval extent_along(const Enclosure& enclosure, const dvec3& origin, const dvec3& axis) {
  double lo = kInfinity;
  double hi = -kInfinity;
  for (std::size_t k = 0; k < enclosure.count; ++k) {
    const double x = glm::dot(enclosure.points[k] - origin, axis);
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  if (enclosure.sigma.lo < enclosure.sigma.hi) {
    double least = kInfinity;
    double most = -kInfinity;
    for (const dvec3& D : enclosure.D) {
      const double x = glm::dot(D, axis);
      least = std::min({least, x * enclosure.sigma.lo, x * enclosure.sigma.hi});
      most = std::max({most, x * enclosure.sigma.lo, x * enclosure.sigma.hi});
    }
    lo += least;
    hi += most;
  }
  const double slack = enclosure.radius + kRounding * glm::length(origin);
  return {lo - slack, hi + slack};
}

}  // namespace trisect
