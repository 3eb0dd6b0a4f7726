// The frames on the device that the window shows.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>

#include "app/buffers/kernel_choice.h"
#include "app/buffers/kernel_code.h"
#include "app/dispatch/trace_settings.h"
#include "app/dispatch/vulkan_tracer.h"

namespace trisect::view {

// A tracer and the frame that it traced last. use() and trace() must not be called while the device
// still draws the frame. For one thread; kernels are made in another.
class Picture {
 public:
  explicit Picture(const gpu::Device& device) : device_(device) {}

  enum class Use {
    as_before,
    anew,  // scene, choice or code are new, and the last frame is lost
    soon,  // kernels are being made: until they are there, the picture is as it was
  };

  // Frames are to show this scene and to be traced by these kernels: those in `code`, or the
  // built-in ones if it is null. Throws DeviceError, and stays as it was, if the device cannot hold
  // them.
  Use use(const std::shared_ptr<const BakedScene>& scene, const KernelChoice& choice,
          const std::shared_ptr<const KernelCode>& code);

  // Has the kernels made that use() needs for this, and returns whether they are there. Throws
  // DeviceError if the device could not make them.
  bool prepare(const std::shared_ptr<const BakedScene>& scene, const KernelChoice& choice,
               const std::shared_ptr<const KernelCode>& code);

  // Returns once no kernels are being made.
  void wait() const;

  // Whether a frame of that size in pixels fits into the device's buffers.
  [[nodiscard]] bool can_hold(uint32_t width, uint32_t height) const;

  // Traces a frame; returns whether it is finished. If keep_going said stop there is no frame
  // afterwards, not even the last one. use() must have been called. Throws UsageError if the camera
  // of the settings is none; DeviceError.
  bool trace(const TraceSettings& settings, const KeepGoing& keep_going);

  // Whether frames have outputs besides colour.
  [[nodiscard]] bool has_aovs() const { return choice_.aovs; }

  // Whether there is a frame. The rest needs one.
  [[nodiscard]] bool is_there() const { return params_.has_value(); }
  [[nodiscard]] uint32_t width() const { return params_->width; }
  [[nodiscard]] uint32_t height() const { return params_->height; }
  [[nodiscard]] const gpu::Buffer& colors() const { return tracer_->colors(); }
  [[nodiscard]] const gpu::Buffer& aovs() const { return tracer_->aovs(); }
  // Copies it from the device.
  void fetch(Frame& frame) { tracer_->fetch(*params_, frame); }

 private:
  const gpu::Device& device_;
  std::shared_ptr<const BakedScene> scene_;
  KernelChoice choice_;
  std::shared_ptr<const KernelCode> code_;
  std::unique_ptr<VulkanTracer> tracer_;
  // Kernels and what they are made from.
  struct CodeKernels {
    std::shared_ptr<const KernelCode> code;
    std::shared_ptr<const TracerKernels> kernels;
  };
  CodeKernels kernels_;
  std::optional<std::future<CodeKernels>> coming_;
  std::optional<TraceParams> params_;  // of the frame
};

}  // namespace trisect::view
