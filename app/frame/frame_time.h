// How long a frame took.
#pragma once

namespace trisect {

// Milliseconds for one frame.
struct FrameTime {
  double gpu_ms = 0.0;   // on the device, all submits added up
  double wall_ms = 0.0;  // from the first submit until the frame is in host memory
};

}  // namespace trisect
