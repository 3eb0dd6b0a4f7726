// The resolution at which frames keep to a time while something moves.
#pragma once

namespace trisect::view {

class Pacer {
 public:
  // The part of the window's sides that a frame may have to be shown within so many milliseconds,
  // from kLeast to 1.
  [[nodiscard]] double scale(double frame_ms) const;

  // What a frame of that scale took to trace, and all that came with it.
  void record(double scale, double trace_ms, double other_ms);

  static constexpr double kLeast = 0.125;

 private:
  double full_ms_ = 0.0;  // a frame of the window's size; 0: nothing is known
  double other_ms_ = 0.0;
};

}  // namespace trisect::view
