#include "app/sphere_range.h"

#include <algorithm>
#include <cmath>

namespace trisect {
namespace {

using glm::dvec3;

// Range of sum_k w_k a_k . b over a part.
Interval linear_range(const std::array<dvec3, 3>& a, const dvec3& b) {
  return hull(hull(dot(a[0], b), dot(a[1], b)), dot(a[2], b));
}

// Range of (sum_k w_k a_k) . (sum_k w_k b_k) over a part: the hull of its Bernstein coefficients.
Interval product_range(const std::array<dvec3, 3>& a, const std::array<dvec3, 3>& b) {
  Interval range = dot(a[0], b[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    range = hull(range, dot(a[i], b[i]));
    range = hull(range, (dot(a[i], b[j]) + dot(a[j], b[i])) * 0.5);
  }
  return range;
}

// Range of the curvature at vertex i, seen from which a convex part spans the angles of its
// corners.
Interval curvature_range(const Patch& patch, std::size_t i, const std::array<dvec3, 3>& T) {
  const dvec3& b = patch.P[i == 2 ? 1 : 2];
  double lowest = 1.0;
  double highest = 0.0;
  for (const dvec3& corner : T) {
    const dvec3 x = corner - patch.P[i];
    if (x == dvec3(0.0)) continue;
    const dvec3 e = b - patch.P[i];
    const double beta = std::atan2(glm::length(glm::cross(x, e)), glm::dot(x, e)) / patch.data[i].z;
    lowest = std::min(lowest, beta);
    highest = std::max(highest, beta);
  }
  // The angle is exact to some ten units in the last place of pi.
  constexpr double rounding = 1e-14;
  const double slack = rounding / patch.data[i].z;
  const Interval beta(std::clamp(lowest - slack, 0.0, 1.0), std::clamp(highest + slack, 0.0, 1.0));
  return patch.data[i].y + beta * (Interval(patch.data[i].x) - patch.data[i].y);
}

// The quadratic A s^2 + 2 B s + C of vertex i over a part, and the ranges it is made of.
struct HeightQuadratic {
  std::array<dvec3, 3> x;  // the corners seen from the vertex
  Interval c;              // curvature
  Interval DD;
  Interval xD;
  Interval xx;
  Interval A;
  Interval B;
  Interval C;
};

HeightQuadratic height_quadratic(const Patch& patch, std::size_t i, const PartCorners& corners) {
  const auto& [T, D] = corners;
  HeightQuadratic q{};
  q.x = {T[0] - patch.P[i], T[1] - patch.P[i], T[2] - patch.P[i]};
  q.c = curvature_range(patch, i, T);
  q.DD = product_range(D, D);
  q.xD = product_range(q.x, D);
  q.xx = product_range(q.x, q.x);
  q.A = q.c * q.DD;
  q.B = q.c * q.xD + linear_range(D, patch.N[i]);
  q.C = q.c * q.xx + Interval(2.0) * linear_range(q.x, patch.N[i]);
  return q;
}

// -C / (B + sign(B) sqrt(B^2 - A C)), or nothing where B may vanish.
std::optional<Interval> root_range(const HeightQuadratic& q) {
  const Interval discriminant_root = root(square(q.B) - q.A * q.C);
  if (q.B.lo > 0.0) return -divide_by_positive(q.C, q.B + discriminant_root);
  if (q.B.hi < 0.0) return divide_by_positive(q.C, discriminant_root - q.B);
  return std::nullopt;
}

// No displacement is longer than the longest edge: of that, at the longest D.
double least_limit(const Patch& patch, const HeightQuadratic& q) {
  return patch.longest / root(q.DD).hi * (1.0 - 1e-14);
}

// Range of s_i over a part, in units of D, or nothing where it is not bounded by this means.
std::optional<Interval> height_range(const Patch& patch, std::size_t i,
                                     const PartCorners& corners) {
  const HeightQuadratic q = height_quadratic(patch, i, corners);
  const std::optional<Interval> s = root_range(q);
  if (!s) return std::nullopt;
  // A root past the limit is drawn back toward 0.
  const double limit = least_limit(patch, q);
  return s->hi > limit || s->lo < -limit ? hull(*s, 0.0) : *s;
}

// Range of the derivative of s_i as T moves by dT and D by dD: A s^2 + 2 B s + C = 0,
// differentiated (sphere_derivative of shaders/surface.glsl). For B > 0, q.xx > 0 and a positive
// discriminant.
Interval derivative_range(const Patch& patch, std::size_t i, const PartCorners& corners,
                          const HeightQuadratic& q, const Interval& s, const dvec3& dT,
                          const dvec3& dD, const dvec3& turn) {
  const dvec3& N = patch.N[i];
  const Interval dc =
      (Interval(patch.data[i].x) - patch.data[i].y) *
      divide_by_positive(linear_range(q.x, glm::cross(dT, turn)), q.xx * patch.data[i].z);
  const Interval dA = dc * q.DD + Interval(2.0) * q.c * linear_range(corners.D, dD);
  const Interval dB =
      dc * q.xD + q.c * (linear_range(corners.D, dT) + linear_range(q.x, dD)) + dot(dD, N);
  const Interval dC = dc * q.xx + Interval(2.0) * (q.c * linear_range(q.x, dT) + dot(dT, N));
  const Interval half_slope = root(square(q.B) - q.A * q.C);
  return -divide_by_positive(dA * square(s) + Interval(2.0) * dB * s + dC,
                             Interval(2.0) * half_slope);
}

// Whether s_i is smooth over a part and q bounds its derivatives.
bool is_smooth(const Patch& patch, std::size_t i, const HeightQuadratic& q,
               const std::optional<Interval>& s) {
  if (!s || !(q.B.lo > 0.0) || !(q.xx.lo > 0.0) || !(patch.data[i].z > 0.0)) return false;
  const double limit = least_limit(patch, q);
  return (square(q.B) - q.A * q.C).lo > 0.0 && s->hi < limit && s->lo > -limit;
}

}  // namespace

std::optional<Interval> sphere_sigma_range(const Patch& patch, const Part& part,
                                           const PartCorners& corners,
                                           const std::optional<Interval>& unbounded) {
  Interval sigma(0.0);
  for (int i = 0; i < 3; ++i) {
    auto s = height_range(patch, static_cast<std::size_t>(i), corners);
    if (!s) s = unbounded;
    if (!s) return std::nullopt;
    const auto [lo, hi] = std::minmax({part[0][i], part[1][i], part[2][i]});
    sigma = sigma + Interval(lo, hi) * *s;
  }
  return sigma;
}

std::optional<SigmaRanges> sphere_derivative_ranges(const Patch& patch, const Part& part,
                                                    const PartCorners& corners) {
  const auto& [P, N, D, data, longest] = patch;
  const dvec3 n = glm::normalize(glm::cross(P[1] - P[0], P[2] - P[0]));
  SigmaRanges sigma{0.0, 0.0, 0.0};
  std::array<Interval, 3> s;
  for (std::size_t i = 0; i < 3; ++i) {
    const HeightQuadratic q = height_quadratic(patch, i, corners);
    const std::optional<Interval> height = root_range(q);
    if (!is_smooth(patch, i, q, height)) return std::nullopt;
    s[i] = *height;
    const int k = static_cast<int>(i);
    const auto [lo, hi] = std::minmax({part[0][k], part[1][k], part[2][k]});
    const Interval w(lo, hi);
    const dvec3 turn = i == 1 ? n : -n;
    sigma.s = sigma.s + w * s[i];
    sigma.u =
        sigma.u + w * derivative_range(patch, i, corners, q, s[i], P[1] - P[0], D[1] - D[0], turn);
    sigma.v =
        sigma.v + w * derivative_range(patch, i, corners, q, s[i], P[2] - P[0], D[2] - D[0], turn);
  }
  sigma.u = sigma.u + s[1] - s[0];
  sigma.v = sigma.v + s[2] - s[0];
  return sigma;
}

}  // namespace trisect
