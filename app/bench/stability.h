// Numerical stability: errors of the solvers as one thing about a scene or its rays goes to
// extremes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace trisect::bench {

// One value of what is varied.
struct StabilityPoint {
  double value = 0.0;
  // Of the rays that the oracle decides: root of the mean square of the distance off the surface
  // over the scene's radius; a ray that only one of the two has hitting counts as off by the
  // radius.
  // NaN if it decides none.
  double error = 0.0;
  std::size_t decided = 0;
  std::size_t wrong = 0;
  std::size_t missed = 0;
  std::size_t nans = 0;
};

struct StabilityCurve {
  std::string solver;
  std::vector<StabilityPoint> points;
};

struct StabilityAxis {
  std::string name;  // for files
  std::string what;  // is varied, with its unit
  bool logarithmic = true;
  std::vector<StabilityCurve> curves;
};

// `rays` for every point, by the kernels as C++, which agree with Vulkan's bit for bit.
std::vector<StabilityAxis> measure_stability(uint32_t rays);

}  // namespace trisect::bench
