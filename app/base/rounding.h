// Bounds in single precision of numbers in double precision.
#pragma once

#include <cmath>
#include <limits>

namespace trisect {

// The least number of single precision that is not less.
inline float rounded_up(double x) {
  const auto nearest = static_cast<float>(x);
  constexpr float most = std::numeric_limits<float>::infinity();
  return static_cast<double>(nearest) < x ? std::nextafterf(nearest, most) : nearest;
}

inline float rounded_down(double x) {
  return -rounded_up(-x);
}

}  // namespace trisect
