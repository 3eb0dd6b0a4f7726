// The Vulkan back end: a baked scene and trace parameters in, a frame out.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/buffers/buffer_limits.h"
#include "app/buffers/kernel_choice.h"
#include "app/buffers/kernel_code.h"
#include "app/buffers/scene_buffers.h"
#include "app/dispatch/ray_queue.h"
#include "app/dispatch/submit_budget.h"
#include "app/dispatch/tile_lists.h"
#include "app/dispatch/workgroups.h"
#include "app/frame/frame.h"
#include "app/frame/frame_time.h"
#include "app/surface/shared.h"
#include "vk/commands.h"

namespace trisect {

class VulkanTracer {
 public:
  // Uploads the scene and compiles the kernels for it. width, height: the most pixels of a frame's
  // sides. buffer_limit: the most bytes a buffer may have, if less than the device's own limit.
  // code: kernels compiled anew, or null for those that were built in. Throws DeviceError if the
  // device cannot hold the scene.
  VulkanTracer(const gpu::Device& device, const BakedScene& scene, uint32_t width, uint32_t height,
               const KernelChoice& choice, std::size_t buffer_limit = kNoLimit,
               const KernelCode* code = nullptr);

  // Renders into `frame`, in submits of bounded time. params.width and .height must be at most the
  // tracer's. keep_going is asked between any two submits; nothing is returned if it says stop, and
  // the frame is not whole.
  std::optional<FrameTime> render(const TraceParams& params, Frame& frame,
                                  const KeepGoing& keep_going = {});

  // The same, but the frame stays on the device, in colors() and aovs(); it must be one that
  // holds_at_once() says. Returns milliseconds on the device.
  std::optional<double> trace(const TraceParams& params, const KeepGoing& keep_going = {});

  // What trace() left on the device.
  void fetch(const TraceParams& params, Frame& frame);

  // Whether the output buffers hold such a frame as a whole.
  [[nodiscard]] bool holds_at_once(uint32_t width, uint32_t height) const {
    return width <= width_ && height <= band_rows_;
  }

  // vec4s, sRGB-encoded, and PixelAovs if the choice has them, in raster order.
  [[nodiscard]] const gpu::Buffer& colors() const { return image_.colors; }
  [[nodiscard]] const gpu::Buffer& aovs() const { return image_.aovs; }

  // For frames of another size. Kernels and scene stay.
  void resize(uint32_t width, uint32_t height);

  [[nodiscard]] double upload_ms() const { return upload_ms_; }

  // Of device memory, for all that is not an image or a queue of rays.
  [[nodiscard]] std::size_t scene_bytes() const {
    return scene_.bytes() + (tiles_ ? tiles_->bytes() : 0);
  }

 private:
  // What depends on the frame's size.
  struct ImageBuffers {
    ImageBuffers(const gpu::Device& device, uint32_t width, uint32_t band_rows, bool with_aovs);

    gpu::Buffer colors;
    gpu::Buffer aovs;
    RayQueue queue;
  };

  [[nodiscard]] gpu::DescriptorSet bind() const;
  void download_band(uint32_t first_row, uint32_t rows, Frame& frame);
  double look(const TraceParams& params);
  std::optional<double> render_band(const TraceParams& params, uint32_t first_row, uint32_t rows,
                                    const KeepGoing& keep_going);
  std::optional<double> run(std::span<const gpu::Kernel> kernels, GroupRange groups,
                            uint32_t first_row, uint32_t rows, const KeepGoing& keep_going);

  const gpu::Device& device_;
  uint32_t width_;
  uint32_t height_;
  bool aovs_;
  bool writes_aovs_;
  std::size_t buffer_limit_;
  uint32_t band_rows_;
  std::optional<TileLists> tiles_;
  SceneBuffers scene_;
  std::vector<gpu::Kernel> kernels_;         // for new rays, then for those that pause
  std::vector<gpu::Kernel> shadow_kernels_;  // the same for shadows
  gpu::Commands commands_;
  gpu::Staging staging_;
  gpu::Buffer params_;
  ImageBuffers image_;
  gpu::Buffer unused_;
  gpu::DescriptorSet bound_;
  double upload_ms_ = 0.0;
  SubmitBudget budget_;
};

}  // namespace trisect
