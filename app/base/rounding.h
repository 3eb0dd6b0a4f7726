// Bounds of roundings, and bounds in single precision of numbers in double precision.
#pragma once

#include <cmath>
#include <limits>

#include "shaders/gamma.h"

namespace trisect {

// gamma(n) = n u / (1 - n u), the relative error of n roundings to nearest in a row
// (shaders/gamma.h): u = 2^-24 for single precision, 2^-53 for double. n > 0.
constexpr double gamma_single(int n) {
  return GAMMA_SINGLE(static_cast<double>, n);
}
constexpr double gamma_double(int n) {
  return GAMMA_DOUBLE(static_cast<double>, n);
}

// The smallest single-precision number that is not less than x.
inline float rounded_up(double x) {
  const auto nearest = static_cast<float>(x);
  constexpr float most = std::numeric_limits<float>::infinity();
  return static_cast<double>(nearest) < x ? std::nextafterf(nearest, most) : nearest;
}

// The largest single-precision number that is not greater than x.
inline float rounded_down(double x) {
  return -rounded_up(-x);
}

}  // namespace trisect
