// The Vulkan back end: a baked scene and trace parameters in, a frame out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/buffers/buffer_limits.h"
#include "app/buffers/kernel_choice.h"
#include "app/buffers/kernel_code.h"
#include "app/buffers/scene_buffers.h"
#include "app/dispatch/band_parts.h"
#include "app/dispatch/ray_queue.h"
#include "app/dispatch/submit_budget.h"
#include "app/dispatch/tile_lists.h"
#include "app/dispatch/tracer_kernels.h"
#include "app/frame/frame.h"
#include "app/frame/frame_time.h"
#include "app/surface/shared.h"
#include "vk/commands.h"

namespace trisect {

// For one thread at a time. The device must outlive the tracer; the scene need not.
class VulkanTracer {
 public:
  // Uploads the scene, its BVH only if the choice needs it, and makes the kernels. width,
  // height: the largest frame in pixels. choice: accelerations and shadows that need the BVH need a
  // scene that has one. buffer_limit: the most bytes of a buffer, if less than the device's own
  // limit. code: as spirv_of() takes it. Throws DeviceError if the device cannot hold the scene or
  // lacks what the choice needs, std::logic_error if the scene lacks the BVH.
  VulkanTracer(const gpu::Device& device, const BakedScene& scene, uint32_t width, uint32_t height,
               const KernelChoice& choice, std::size_t buffer_limit = kNoLimit,
               const KernelCode* code = nullptr);

  // The same with kernels that are there: of plan_kernels() of this device, scene and choice,
  // without a limit of buffers.
  VulkanTracer(const gpu::Device& device, const BakedScene& scene, uint32_t width, uint32_t height,
               const KernelChoice& choice, std::shared_ptr<const TracerKernels> kernels);

  // Renders into `frame`, which gets the size that `params` says, in submits of bounded time: in
  // one if that is enough. An image that the output buffers do not hold is rendered in bands of
  // rows. progress is told between two submits what part of the frame is done; if it says stop,
  // nothing is returned and the frame is incomplete. Throws std::logic_error if the image is larger
  // than the tracer's, DeviceError if the device is lost.
  std::optional<FrameTime> render(const TraceParams& params, Frame& frame,
                                  const FractionProgress& progress = {});

  // The same, but the frame stays on the device, in colors() and aovs(). Returns milliseconds on
  // the device. Throws std::logic_error unless holds_at_once() is true for the frame's size.
  std::optional<double> trace(const TraceParams& params, const FractionProgress& progress = {});

  // Copies the frame that trace() left on the device. params: those of trace().
  void fetch(const TraceParams& params, Frame& frame);

  // Whether the output buffers hold a frame of this size as a whole.
  [[nodiscard]] bool holds_at_once(uint32_t width, uint32_t height) const {
    return width <= width_ && height <= band_rows_;
  }

  // The output buffers, in raster order: a vec4 per pixel, RGB encoded as sRGB and alpha; and a
  // PixelAovs per pixel if the choice has AOVs or shadows, else one element. resize() replaces
  // them.
  [[nodiscard]] const gpu::Buffer& colors() const { return image_.colors; }
  [[nodiscard]] const gpu::Buffer& aovs() const { return image_.aovs; }

  // For frames of another size; kernels and scene stay. If it throws DeviceError, for lack of
  // memory, the tracer holds no frame and can be resized again.
  void resize(uint32_t width, uint32_t height);

  // What the constructor took for the upload, by the host's clock.
  [[nodiscard]] double upload_ms() const { return upload_ms_; }

  // How many submits all that this tracer has done took.
  [[nodiscard]] uint64_t submits() const { return commands_.submits(); }

  // Bytes of device memory for the scene and for tile lists: all but the images and the ray queue.
  [[nodiscard]] std::size_t scene_bytes() const {
    return scene_.bytes() + (tiles_ ? tiles_->bytes() : 0);
  }

 private:
  // The buffers whose sizes depend on the frame's.
  struct ImageBuffers {
    ImageBuffers(const gpu::Device& device, uint32_t width, uint32_t band_rows, bool with_aovs,
                 std::size_t buffer_limit);

    gpu::Buffer colors;
    gpu::Buffer aovs;
    RayQueue queue;
  };

  // kernels: null to make them.
  VulkanTracer(const gpu::Device& device, const BakedScene& scene, uint32_t width, uint32_t height,
               const KernelChoice& choice, std::size_t buffer_limit, const KernelCode* code,
               std::shared_ptr<const TracerKernels> kernels);
  [[nodiscard]] gpu::DescriptorSet bind() const;
  void download_band(uint32_t first_row, uint32_t rows, Frame& frame);
  // Sets what the frame has counted of the work of the last frame.
  void count_work(Frame& frame) const;
  [[nodiscard]] std::span<const gpu::Kernel> kernels_of(const BandParts::Part& part) const {
    return part.shadows ? kernels_->shadow_rays() : kernels_->camera_rays();
  }
  // Traces a band in as few submits as the budget allows; with the first one of a frame goes what
  // the frame begins with. Returns milliseconds on the device, or nothing if progress stopped it.
  std::optional<double> render_band(const TraceParams& params, uint32_t first_row, uint32_t rows,
                                    const FractionProgress& progress);
  // Record, into a submit: what a frame begins with; all passes of a part for which there are
  // kernels of their own.
  void record_frame(const TraceParams& params);
  void record_part(const BandParts::Part& part, uint32_t first_row, uint32_t rows);
  // Goes on with the rays of a part that have paused, if there are any, a submit for each pass.
  std::optional<double> finish_rays(const BandParts::Part& part, uint32_t first_row, uint32_t rows,
                                    const KeepGoing& keep_going);

  const gpu::Device& device_;
  uint32_t width_;
  uint32_t height_;
  bool aovs_;
  bool writes_aovs_;
  std::size_t buffer_limit_;
  uint32_t band_rows_;
  std::optional<TileLists> tiles_;
  SceneBuffers scene_;
  std::shared_ptr<const TracerKernels> kernels_;
  gpu::Commands commands_;
  gpu::Staging staging_;
  gpu::Buffer params_;
  ImageBuffers image_;
  gpu::Buffer unused_;
  gpu::DescriptorSet descriptors_;
  double upload_ms_ = 0.0;
  SubmitBudget budget_;
};

}  // namespace trisect
