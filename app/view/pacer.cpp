#include "app/view/pacer.h"

#include <algorithm>
#include <cmath>

namespace trisect::view {
namespace {

// The scale before any frame was recorded.
constexpr double kFirst = 0.5;
// Scales are multiples of 1/kSteps: a picture whose resolution changes with every frame shimmers.
constexpr double kSteps = 32.0;
// Weight of the last estimate in the next: a frame that another program held up is soon forgotten.
constexpr double kMemory = 0.5;

double updated(double estimate, double measured) {
  return estimate > 0.0 ? kMemory * estimate + (1.0 - kMemory) * measured : measured;
}

}  // namespace

double Pacer::scale(double frame_ms) const {
  if (full_ms_ <= 0.0) return kFirst;
  // Part of the time that tracing may take however long the rest does: that may only be a wait for
  // the display.
  constexpr double least_part = 0.4;
  const double left = std::max(frame_ms - other_ms_, least_part * frame_ms);
  const double side = std::sqrt(left / full_ms_);
  return std::clamp(std::floor(side * kSteps) / kSteps, kLeast, 1.0);
}

void Pacer::record(double scale, double trace_ms, double other_ms) {
  full_ms_ = updated(full_ms_, trace_ms / (scale * scale));
  other_ms_ = updated(other_ms_, other_ms);
}

}  // namespace trisect::view
