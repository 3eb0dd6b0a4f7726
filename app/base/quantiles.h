// Quantiles of measured errors, and the angle, one of their units.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace trisect {

// Quantiles of a sample: the median, the value that 1% exceed, the largest. All are 0 for an empty
// sample.
struct Quantiles {
  double p50 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

Quantiles quantiles_of(std::vector<double> values);

// The angle between two vectors in degrees, from 0 to 180; small angles are as accurate as large
// ones.
double degrees_between(const glm::dvec3& a, const glm::dvec3& b);

}  // namespace trisect
