// One call for every back end: a baked scene and trace parameters in, a frame out.
#pragma once

#include <string>
#include <vector>

#include "app/bake.h"
#include "app/frame.h"
#include "app/frame_time.h"
#include "app/kernel_choice.h"
#include "app/options.h"

namespace trisect {

struct TraceRequest {
  Backend backend = Backend::vulkan;
  GlPath gl_path = GlPath::compute;
  std::string device;       // Vulkan's; empty for the best one
  bool validation = false;  // Vulkan's
  uint32_t runs = 1;        // frames to time
  bool warm_up = true;      // a frame before them, on devices
};

struct TraceResult {
  Frame frame;
  std::string device;
  std::string driver;
  double upload_ms = 0.0;
  std::vector<FrameTime> frames;      // of the runs
  std::vector<std::string> messages;  // of the validation layer
};

// Host back ends show their progress. Throws gpu::Error if there is no device or it cannot hold the
// scene, Interrupted when the user stops it.
TraceResult trace_scene(const TraceRequest& request, const BakedScene& scene,
                        const TraceParams& params, const KernelChoice& choice);

}  // namespace trisect
