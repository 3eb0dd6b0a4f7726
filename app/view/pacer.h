// Chooses the resolution of moving frames so that each keeps to a given time.
#pragma once

namespace trisect::view {

// Learns from the frames so far what tracing the whole window costs. Not thread safe.
class Pacer {
 public:
  // Sides of the next frame over those of the window, from kLeast to 1, so that all of the frame
  // probably takes this many milliseconds at most.
  [[nodiscard]] double scale(double frame_ms) const;

  // Milliseconds that a frame of this scale took to trace, and for everything else.
  void record(double scale, double trace_ms, double other_ms);

  static constexpr double kLeast = 0.125;

 private:
  double full_ms_ = 0.0;   // estimate for tracing a frame of the window's size; 0: none yet
  double other_ms_ = 0.0;  // estimate for everything else
};

}  // namespace trisect::view
