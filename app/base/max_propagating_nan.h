// The largest of several numbers, of which some may not be numbers.
#pragma once

#include <cmath>

namespace trisect {

// The larger one; a NaN is larger than anything.
inline void max_propagating_nan(double& most, double value) {
  if (!std::isnan(most) && !(value <= most)) most = value;
}

}  // namespace trisect
