#include "app/base/ulp.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trisect {

double ulp_of(double x) {
  using Float = std::numeric_limits<float>;
  int exponent = 0;
  const double mantissa = std::frexp(std::fabs(x), &exponent);
  // Below a power of two, floats are twice as close to each other as above it.
  if (mantissa == 0.5) --exponent;
  if (x == 0.0) exponent = Float::min_exponent;
  // Denormals are as far from each other as the smallest normal numbers.
  return std::ldexp(1.0, std::max(exponent, Float::min_exponent) - Float::digits);
}

double ulp_error(float result, double exact) {
  if (!std::isfinite(result)) return std::numeric_limits<double>::infinity();
  return std::fabs(result - exact) / ulp_of(exact);
}

}  // namespace trisect
