// Numerical stability: how the solvers' errors grow as one property of a scene or of its rays goes
// to extremes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace trisect::bench {

// The errors at one value of the property that is varied. Rays are judged by classify(), but a
// wrong patch or root counts by its distance only.
struct StabilityPoint {
  double value = 0.0;  // of the property, in the unit that StabilityAxis::what names
  // Root mean square over the rays that the oracle decides of the distance off the surface,
  // |depth error| |n.d|, over the scene's radius. A ray that only one of solver and oracle sees
  // hit, or that is NaN, counts as off by the radius. NaN if the oracle decides no ray.
  double error = 0.0;
  std::size_t decided = 0;
  std::size_t wrong = 0;   // of these, hits where the oracle misses
  std::size_t missed = 0;  // of these, misses where the oracle hits
  std::size_t nans = 0;    // of all rays; these count in none of the two above
};

struct StabilityCurve {
  std::string solver;
  std::vector<StabilityPoint> points;
};

struct StabilityAxis {
  std::string name;                    // a word, for files
  std::string what;                    // the property that is varied, and its unit
  bool logarithmic = true;             // whether plots show its values on a logarithmic scale
  std::vector<StabilityCurve> curves;  // one for each solver, all at the same values
};

// Measures all axes with `rays` rays at every value, by the kernels compiled as C++, which agree
// with Vulkan's bit for bit. Shows its progress on standard error; throws Interrupted after Ctrl-C.
std::vector<StabilityAxis> measure_stability(uint32_t rays);

}  // namespace trisect::bench
