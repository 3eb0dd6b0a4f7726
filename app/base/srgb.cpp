#include "app/base/srgb.h"

#include <cmath>

namespace trisect {

float linear_from_srgb(float encoded) {
  const auto x = static_cast<double>(encoded);
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

float srgb_from_linear(float linear) {
  const auto x = static_cast<double>(linear);
  return static_cast<float>(x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

}  // namespace trisect
