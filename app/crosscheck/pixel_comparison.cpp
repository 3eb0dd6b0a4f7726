#include "app/crosscheck/pixel_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "app/base/error.h"
#include "app/base/max_propagating_nan.h"

namespace trisect {

bool is_hit(const Frame& frame, std::size_t pixel) {
  return frame.aovs.empty() ? frame.colors[pixel].w > 0.0F
                            : frame.aovs[pixel].triangle != NO_TRIANGLE;
}

bool same_bits(float a, float b) {
  return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

void expect_same_size(const Frame& a, const Frame& b) {
  if (a.width == b.width && a.height == b.height) return;
  throw InputError(fmt::format("images of {}x{} and {}x{} pixels cannot be compared.", a.width,
                               a.height, b.width, b.height));
}

double apart(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  return std::abs(static_cast<double>(a) - static_cast<double>(b));
}

ColorDifference color_difference(const Frame& a, const Frame& b) {
  ColorDifference difference;
  double squares = 0.0;
  for (std::size_t i = 0; i < a.colors.size(); ++i) {
    const vec4& p = a.colors[i];
    const vec4& q = b.colors[i];
    bool both_nan = false;
    for (int k = 0; k < 3; ++k) {
      const double steps = 255.0 * apart(p[k], q[k]);
      squares += steps * steps;
      max_propagating_nan(difference.largest, steps);
      if (std::isfinite(steps)) {
        difference.largest_number = std::max(difference.largest_number, steps);
      }
      both_nan = both_nan || (std::isnan(p[k]) && std::isnan(q[k]));
    }
    difference.nan_pixels += both_nan ? 1 : 0;
    // What one of them hits is counted as such.
    const double alpha = 255.0 * apart(p.w, q.w);
    if (std::isnan(alpha) || is_hit(a, i) == is_hit(b, i)) {
      max_propagating_nan(difference.alpha, alpha);
    }
  }
  difference.rmse = std::sqrt(squares / (3.0 * static_cast<double>(a.colors.size())));
  return difference;
}

}  // namespace trisect
