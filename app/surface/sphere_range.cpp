#include "app/surface/sphere_range.h"

#include <algorithm>
#include <cmath>

#include "app/surface/surface_double.h"

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

// Range of the curvature at vertex i. Seen from there a convex part spans the angles of its
// corners, T.
Interval curvature_range(const Patch& patch, std::size_t i, const std::array<dvec3, 3>& T) {
  const dvec3 e = patch.P[i == 2 ? 1 : 2] - patch.P[i];
  // The axis about which the angle from e grows, backward.
  const dvec3 axis = i == 1 ? -patch.n : patch.n;
  double lowest = kInfinity;
  double highest = -kInfinity;
  for (const dvec3& corner : T) {
    const dvec3 x = corner - patch.P[i];
    if (x == dvec3(0.0)) continue;
    const dvec3 sine = glm::cross(x, e);
    const double size = std::atan2(glm::length(sine), glm::dot(x, e));
    const double angle = glm::dot(sine, axis) < 0.0 ? -size : size;
    lowest = std::min(lowest, angle);
    highest = std::max(highest, angle);
  }
  // Around the vertex, or across the line behind it, at which the angle ends.
  constexpr double right_angle = 1.57;
  if (lowest <= 0.0 && highest >= 0.0 && std::max(-lowest, highest) > right_angle) {
    lowest = -kInfinity;
    highest = kInfinity;
  }
  // The angle is exact to some ten units in the last place of pi.
  constexpr double rounding = 1e-14;
  const double all = patch.data[i].z;
  const auto blend = [&](double angle) {
    return std::clamp(angle / all, in_double::LEAST_BLEND, in_double::MOST_BLEND);
  };
  return patch.data[i].y + Interval(blend(lowest - rounding), blend(highest + rounding)) *
                               (Interval(patch.data[i].x) - patch.data[i].y);
}

// The quadratic A s^2 + 2 B s + C of vertex i over a part, and the ranges it is made of.
struct HeightQuadratic {
  std::array<dvec3, 3> x;  // the corners seen from the vertex
  Interval c;              // curvature
  Interval DD;
  Interval DN;
  Interval xD;
  Interval xx;
  Interval A;
  Interval B;
  Interval C;
  Interval discriminant;
};

HeightQuadratic height_quadratic(const Patch& patch, std::size_t i, const PartCorners& corners) {
  const auto& [T, D] = corners;
  HeightQuadratic q{};
  q.x = {T[0] - patch.P[i], T[1] - patch.P[i], T[2] - patch.P[i]};
  q.c = curvature_range(patch, i, T);
  q.DD = direction_square_range(patch, corners);
  q.DN = linear_range(D, patch.N[i]);
  q.xD = product_range(q.x, D);
  q.xx = product_range(q.x, q.x);
  q.A = q.c * q.DD;
  q.B = q.c * q.xD + q.DN;
  q.C = q.c * q.xx + Interval(2.0) * linear_range(q.x, patch.N[i]);
  q.discriminant = square(q.B) - q.A * q.C;
  return q;
}

Interval intersection(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

// The range of sphere_root (shaders/surface.glsl), or nothing where A and B may both vanish.
std::optional<Interval> root_range(const HeightQuadratic& q) {
  const Interval discriminant_root = root(q.discriminant);
  std::optional<Interval> range;
  // (root - B) / A, whether the line meets the sphere or not.
  if (q.A.lo > 0.0) range = divide_by_positive(discriminant_root - q.B, q.A);
  if (q.A.hi < 0.0) range = divide_by_positive(q.B - discriminant_root, -q.A);
  if (q.B.lo > 0.0) {
    // -C / (B + root) where it meets it. Where it does not, B^2 <= A C, so that -B / A lies between
    // 0 and -C / B.
    Interval other = -divide_by_positive(q.C, q.B + discriminant_root);
    if (q.discriminant.lo <= 0.0) other = hull(other, hull(0.0, -divide_by_positive(q.C, q.B)));
    range = range ? intersection(*range, other) : other;
  }
  return range;
}

// The range of height_limit, for q.DD > 0.
Interval limit_range(const HeightQuadratic& q) {
  const Interval D = root(q.DD);
  const Interval share = divide_by_positive(q.DN, D * in_double::FLAT_SINE);
  return divide_by_positive(
      Interval(std::clamp(share.lo, 0.0, 1.0), std::clamp(share.hi, 0.0, 1.0)) * root(q.xx), D);
}

// Range of s_i over a part, in units of D, or nothing where D may vanish.
std::optional<Interval> height_range(const Patch& patch, std::size_t i,
                                     const PartCorners& corners) {
  const HeightQuadratic q = height_quadratic(patch, i, corners);
  if (!(q.DD.lo > 0.0)) return std::nullopt;
  const Interval limit = limit_range(q);
  const Interval s = root_range(q).value_or(Interval(-kInfinity, kInfinity));
  return Interval(s.lo > 0.0 ? std::min(s.lo, limit.lo) : std::max(s.lo, -limit.hi),
                  s.hi > 0.0 ? std::min(s.hi, limit.hi) : std::max(s.hi, -limit.lo));
}

// Range of the derivative of s_i as T moves by dT and D by dD: A s^2 + 2 B s + C = 0,
// differentiated (sphere_derivative of shaders/surface.glsl). For q.xx > 0 and a positive
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
  const Interval half_slope = root(q.discriminant);
  return -divide_by_positive(dA * square(s) + Interval(2.0) * dB * s + dC,
                             Interval(2.0) * half_slope);
}

// Whether the limit is a smooth function of D over a part.
bool limit_is_smooth(const HeightQuadratic& q) {
  const Interval flat = root(q.DD) * in_double::FLAT_SINE;
  return q.DN.hi < 0.0 || q.DN.lo > flat.hi || (q.DN.lo > 0.0 && q.DN.hi < flat.lo);
}

// Whether a root with these ranges stays within its limit.
bool is_within_limit(const Patch& patch, std::size_t i, const HeightQuadratic& q, const Interval& s,
                     double least_limit) {
  if (s.hi < least_limit && s.lo > -least_limit) return true;
  if (!(q.B.lo > 0.0) || !(q.discriminant.lo > 0.0)) return false;
  // Next to the vertex, where both fall to 0, what they are to the distance x from it:
  // |s| <= (|c| x + 2 |x.N| / x) x / (B + root), x.N no more than N's length along the face.
  const double along = glm::length(patch.N[i] - patch.n * glm::dot(patch.N[i], patch.n));
  const double slope = (std::max(-q.c.lo, q.c.hi) * root(q.xx).hi + 2.0 * along) /
                       (q.B.lo + root(q.discriminant).lo);
  const Interval D = root(q.DD);
  constexpr double rounding = 1e-12;
  return slope + rounding < std::min(q.DN.lo / (in_double::FLAT_SINE * D.hi), 1.0) / D.hi;
}

// Whether s_i, which the root puts into s, has no kink over a part: it is the limit all over it, or
// nowhere, and then all of the lines meet the sphere or none.
bool is_smooth_where_bounded(const Patch& patch, std::size_t i, const HeightQuadratic& q,
                             const std::optional<Interval>& s) {
  if (!(q.DD.lo > 0.0)) return false;
  if (q.DN.hi < 0.0) return true;
  if (!s) return false;
  const Interval limit = limit_range(q);
  if (s->lo > limit.hi || s->hi < -limit.hi) return limit_is_smooth(q);
  return (q.discriminant.lo > 0.0 || q.discriminant.hi < 0.0) &&
         is_within_limit(patch, i, q, *s, limit.lo);
}

// Whether s_i is smooth over a part and q bounds its derivatives.
bool is_smooth(const Patch& patch, std::size_t i, const HeightQuadratic& q,
               const std::optional<Interval>& s) {
  if (!s || !(q.DD.lo > 0.0) || !(q.xx.lo > 0.0) || !(patch.data[i].z > 0.0)) return false;
  const double limit = limit_range(q).lo;
  return q.discriminant.lo > 0.0 && s->hi < limit && s->lo > -limit;
}

}  // namespace

// (D.n)^2 at least, which the coefficients may miss by much where directions turn fast.
Interval direction_square_range(const Patch& patch, const PartCorners& corners) {
  const Interval range = product_range(corners.D, corners.D);
  const double above = linear_range(corners.D, patch.n).lo;
  // Of n's length.
  constexpr double rounding = 1e-14;
  return above > 0.0 ? Interval(std::max(range.lo, above * above * (1.0 - rounding)), range.hi)
                     : range;
}

std::optional<Interval> sphere_sigma_range(const Patch& patch, const Part& part,
                                           const PartCorners& corners) {
  Interval sigma(0.0);
  for (int i = 0; i < 3; ++i) {
    const auto s = height_range(patch, static_cast<std::size_t>(i), corners);
    if (!s) return std::nullopt;
    const auto [lo, hi] = std::minmax({part[0][i], part[1][i], part[2][i]});
    sigma = sigma + Interval(lo, hi) * *s;
  }
  return sigma;
}

bool sphere_is_smooth(const Patch& patch, const Part& part) {
  const PartCorners corners = corners_of(patch, part);
  for (std::size_t i = 0; i < 3; ++i) {
    const HeightQuadratic q = height_quadratic(patch, i, corners);
    if (!is_smooth_where_bounded(patch, i, q, root_range(q))) return false;
  }
  return true;
}

std::optional<SigmaRanges> sphere_derivative_ranges(const Patch& patch, const Part& part,
                                                    const PartCorners& corners) {
  const auto& P = patch.P;
  const auto& D = patch.D;
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
    const dvec3 turn = i == 1 ? patch.n : -patch.n;
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
