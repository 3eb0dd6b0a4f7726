// Interval arithmetic in double precision: every result contains the exact one, whatever the
// rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "app/base/rounding.h"

namespace trisect {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The numbers from lo to hi, both included. An operation with a NaN gives an interval of no
// meaning: whoever uses a result must compare so that a NaN proves nothing.
struct Interval {
  double lo = 0.0;
  double hi = 0.0;

  Interval() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number is an interval
  Interval(double value) : lo(value), hi(value) {}
  Interval(double low, double high) : lo(low), hi(high) {}
};

// An interval with its ends moved outward by two units in the last place or by the smallest
// positive number. Rounding to nearest moves a result by half a unit at most.
inline Interval outward(double lo, double hi) {
  constexpr double ulps = 2.0 * std::numeric_limits<double>::epsilon();
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  return {lo - std::abs(lo) * ulps - tiny, hi + std::abs(hi) * ulps + tiny};
}

// The smallest interval that contains both.
inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

// The largest size of its numbers; NaN if one of its ends is.
inline double magnitude(const Interval& a) {
  const double lo = std::abs(a.lo);
  const double hi = std::abs(a.hi);
  return std::isnan(lo) || lo > hi ? lo : hi;
}

inline double middle(const Interval& a) {
  return a.lo * 0.5 + a.hi * 0.5;
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

// Of two exact vectors: a dot product is off by gamma(3) times the sum of its products' sizes,
// which is itself rounded, as is the subtraction here.
inline Interval dot(const glm::dvec3& a, const glm::dvec3& b) {
  constexpr double roundings = gamma_double(10);
  constexpr double tiny = 8.0 * std::numeric_limits<double>::denorm_min();
  const double value = a.x * b.x + a.y * b.y + a.z * b.z;
  const double slack =
      (std::abs(a.x * b.x) + std::abs(a.y * b.y) + std::abs(a.z * b.z)) * roundings + tiny;
  return {value - slack, value + slack};
}

}  // namespace trisect
