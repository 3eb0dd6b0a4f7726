#include "tests/support/frame_difference.h"

#include <algorithm>
#include <cmath>

#include "app/base/max_propagating_nan.h"
#include "app/base/quantiles.h"

namespace trisect::test {

FrameDifference difference(const Frame& a, const Frame& b) {
  FrameDifference result;
  result.same_size = a.width == b.width && a.height == b.height && a.aovs.size() == b.aovs.size();
  if (!result.same_size) return result;
  for (std::size_t i = 0; i < a.aovs.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      max_propagating_nan(result.color,
                          std::abs(static_cast<double>(a.colors[i][k] - b.colors[i][k])));
    }
    const PixelAovs& p = a.aovs[i];
    const PixelAovs& q = b.aovs[i];
    const bool hit_a = p.triangle != NO_TRIANGLE;
    const bool hit_b = q.triangle != NO_TRIANGLE;
    if (hit_a != hit_b || a.colors[i].w != b.colors[i].w) ++result.hit_mismatches;
    if (!hit_a || !hit_b) continue;
    max_propagating_nan(result.depth, std::abs(static_cast<double>(p.normal_z.w - q.normal_z.w)));
    if (p.triangle != q.triangle) {
      ++result.patch_mismatches;
      continue;
    }
    max_propagating_nan(result.normal_degrees,
                        degrees_between(glm::dvec3(p.normal_z), glm::dvec3(q.normal_z)));
    max_propagating_nan(result.normal_degrees,
                        degrees_between(glm::dvec3(p.geometric_u), glm::dvec3(q.geometric_u)));
    max_propagating_nan(result.weights,
                        std::abs(static_cast<double>(p.geometric_u.w - q.geometric_u.w)));
    max_propagating_nan(result.weights, std::abs(static_cast<double>(p.v - q.v)));
  }
  return result;
}

}  // namespace trisect::test
