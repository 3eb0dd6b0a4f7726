#include "app/view/pacer.h"

#include <algorithm>
#include <cmath>

namespace trisect::view {
namespace {

// Before anything is known.
constexpr double kFirst = 0.5;
// Scales are so many in a whole: a picture whose resolution changed with every frame would shimmer.
constexpr double kSteps = 32.0;
// What is kept of a cost that was known: one frame that something else held up is soon forgotten.
constexpr double kMemory = 0.5;

double learned(double known, double seen) {
  return known > 0.0 ? kMemory * known + (1.0 - kMemory) * seen : seen;
}

}  // namespace

double Pacer::scale(double frame_ms) const {
  if (full_ms_ <= 0.0) return kFirst;
  // However long the rest takes, which may be a wait for the screen, this part is for the picture.
  constexpr double least_part = 0.4;
  const double left = std::max(frame_ms - other_ms_, least_part * frame_ms);
  const double side = std::sqrt(left / full_ms_);
  return std::clamp(std::floor(side * kSteps) / kSteps, kLeast, 1.0);
}

void Pacer::record(double scale, double trace_ms, double other_ms) {
  full_ms_ = learned(full_ms_, trace_ms / (scale * scale));
  other_ms_ = learned(other_ms_, other_ms);
}

}  // namespace trisect::view
