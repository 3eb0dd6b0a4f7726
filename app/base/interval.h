// Interval arithmetic in double precision: every result contains the exact one, whatever the
// rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace trisect {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Interval {
  double lo = 0.0;
  double hi = 0.0;

  Interval() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number is an interval
  Interval(double value) : lo(value), hi(value) {}
  Interval(double low, double high) : lo(low), hi(high) {}
};

// One rounding to nearest moves a result by half a unit in its last place; this moves it outward by
// two, or by the smallest number there is.
inline Interval outward(double lo, double hi) {
  constexpr double ulps = 2.0 * std::numeric_limits<double>::epsilon();
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  return {lo - std::abs(lo) * ulps - tiny, hi + std::abs(hi) * ulps + tiny};
}

inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

inline Interval operator-(const Interval& a) {
  return {-a.hi, -a.lo};
}
inline Interval operator+(const Interval& a, const Interval& b) {
  return outward(a.lo + b.lo, a.hi + b.hi);
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return outward(a.lo - b.hi, a.hi - b.lo);
}
inline Interval operator*(const Interval& a, const Interval& b) {
  const auto [lo, hi] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
  return outward(lo, hi);
}

// a / b for 0 < b.lo.
inline Interval divide_by_positive(const Interval& a, const Interval& b) {
  const auto [lo, hi] = std::minmax({a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi});
  return outward(lo, hi);
}

inline Interval square(const Interval& a) {
  const double low = std::max({0.0, a.lo, -a.hi});
  const double high = std::max(-a.lo, a.hi);
  const Interval result = outward(low * low, high * high);
  return {std::max(result.lo, 0.0), result.hi};
}

// The square root of max(a, 0).
inline Interval root(const Interval& a) {
  const Interval result = outward(std::sqrt(std::max(a.lo, 0.0)), std::sqrt(std::max(a.hi, 0.0)));
  return {std::max(result.lo, 0.0), result.hi};
}

// Of two exact vectors. Five roundings, each of no more than the sum of the products' sizes.
inline Interval dot(const glm::dvec3& a, const glm::dvec3& b) {
  constexpr double roundings = 5.0 * std::numeric_limits<double>::epsilon();
  constexpr double tiny = 8.0 * std::numeric_limits<double>::denorm_min();
  const double value = a.x * b.x + a.y * b.y + a.z * b.z;
  const double slack =
      (std::abs(a.x * b.x) + std::abs(a.y * b.y) + std::abs(a.z * b.z)) * roundings + tiny;
  return {value - slack, value + slack};
}

}  // namespace trisect
