// How long a frame took, in milliseconds.
#pragma once

namespace trisect {

struct FrameTime {
  double gpu_ms = 0.0;   // on the device, the sum over all submits; 0 on the CPU
  double wall_ms = 0.0;  // from the first submit until the frame is in host memory
};

}  // namespace trisect
