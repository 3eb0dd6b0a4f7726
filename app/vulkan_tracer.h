// The Vulkan back end: a baked scene and trace parameters in, a frame out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "app/bake.h"
#include "app/buffer_limits.h"
#include "app/frame.h"
#include "app/frame_time.h"
#include "app/kernel_choice.h"
#include "app/ray_queue.h"
#include "app/scene_buffers.h"
#include "app/shared.h"
#include "app/submit_budget.h"
#include "app/tile_lists.h"
#include "vk/commands.h"

namespace trisect {

class VulkanTracer {
 public:
  // Uploads the scene and compiles the kernel for it. width, height: pixels of the frames.
  // buffer_limit: the most bytes a buffer may have, if less than the device's own limit. Throws
  // gpu::Error if the device cannot hold the scene.
  VulkanTracer(const gpu::Device& device, const BakedScene& scene, uint32_t width, uint32_t height,
               const KernelChoice& choice, std::size_t buffer_limit = kNoLimit);

  // Renders into `frame`, in submits of bounded time. params.width and .height must be the
  // tracer's. between_submits, if set, is called between any two; what it throws stops the frame.
  FrameTime render(const TraceParams& params, Frame& frame,
                   const std::function<void()>& between_submits = {});

  [[nodiscard]] double upload_ms() const { return upload_ms_; }

 private:
  double render_band(uint32_t first_row, uint32_t rows,
                     const std::function<void()>& between_submits);

  const gpu::Device& device_;
  uint32_t width_;
  uint32_t height_;
  bool aovs_;
  std::size_t buffer_limit_;
  uint32_t band_rows_;
  std::optional<TileLists> tiles_;
  SceneBuffers scene_;
  std::vector<gpu::Kernel> kernels_;  // for new rays, then for those that pause
  gpu::Commands commands_;
  gpu::Staging staging_;
  gpu::Buffer params_;
  gpu::Buffer colors_;
  gpu::Buffer aovs_buffer_;
  RayQueue queue_;
  gpu::Buffer unused_;
  gpu::BoundBuffers bound_;
  double upload_ms_ = 0.0;
  SubmitBudget budget_;
};

}  // namespace trisect
