// What a sample of errors is summed up in.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace trisect {

// Of a sample: the middle one, the one that 1% exceed, the largest. 0 for an empty sample.
struct Quantiles {
  double p50 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

Quantiles quantiles_of(std::vector<double> values);

// Distance from |x| to the next larger single.
double ulp_of(float x);

// Angle between two vectors, accurate for small ones too.
double degrees_between(const glm::dvec3& a, const glm::dvec3& b);

}  // namespace trisect
