// The box around points.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace trisect {

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

// Without points low is above high.
inline Bounds bounds_of(const std::vector<glm::dvec3>& points) {
  Bounds bounds;
  for (const glm::dvec3& p : points) {
    bounds.low = glm::min(bounds.low, p);
    bounds.high = glm::max(bounds.high, p);
  }
  return bounds;
}

inline glm::dvec3 middle_of(const Bounds& bounds) {
  return bounds.low + (bounds.high - bounds.low) * 0.5;
}

}  // namespace trisect
