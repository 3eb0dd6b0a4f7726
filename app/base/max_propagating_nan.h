// A running maximum that a NaN does not get lost in.
#pragma once

#include <cmath>

namespace trisect {

// Raises `most` to `value` if that is larger. A NaN counts as larger than every number, so that a
// bound made of a NaN is seen to be none; std::max would drop it.
inline void max_propagating_nan(double& most, double value) {
  if (!std::isnan(most) && !(value <= most)) most = value;
}

}  // namespace trisect
