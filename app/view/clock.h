// The clock of the window's loop.
#pragma once

#include <chrono>

namespace trisect::view {

using Clock = std::chrono::steady_clock;

// Seconds from `a` until `b`.
inline double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace trisect::view
