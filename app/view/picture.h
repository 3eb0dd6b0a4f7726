// The frame on the device that the window shows.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "app/buffers/kernel_choice.h"
#include "app/buffers/kernel_code.h"
#include "app/dispatch/trace_settings.h"
#include "app/dispatch/vulkan_tracer.h"

namespace trisect::view {

class Picture {
 public:
  explicit Picture(const gpu::Device& device) : device_(device) {}

  // What is traced from now on, by which kernels: those in `code`, or null for those that were
  // built in. Returns whether that is something new. Throws DeviceError, and goes on with what it
  // had, if the device cannot.
  bool use(const std::shared_ptr<const BakedScene>& scene, const KernelChoice& choice,
           const std::shared_ptr<const KernelCode>& code);

  // Whether a frame of that size fits into the device's buffers.
  [[nodiscard]] bool can_hold(uint32_t width, uint32_t height) const;

  // Returns milliseconds on the device; nothing, and there is no frame, if keep_going said stop.
  std::optional<double> trace(const TraceSettings& settings, const KeepGoing& keep_going);

  // Whether its frames have outputs beside colour.
  [[nodiscard]] bool has_aovs() const { return choice_.aovs; }

  // Whether there is a frame; the others are of that.
  [[nodiscard]] bool is_there() const { return params_.has_value(); }
  [[nodiscard]] uint32_t width() const { return params_->width; }
  [[nodiscard]] uint32_t height() const { return params_->height; }
  [[nodiscard]] const gpu::Buffer& colors() const { return tracer_->colors(); }
  [[nodiscard]] const gpu::Buffer& aovs() const { return tracer_->aovs(); }
  void fetch(Frame& frame) { tracer_->fetch(*params_, frame); }

 private:
  const gpu::Device& device_;
  std::shared_ptr<const BakedScene> scene_;
  KernelChoice choice_;
  std::shared_ptr<const KernelCode> code_;
  std::unique_ptr<VulkanTracer> tracer_;
  std::optional<TraceParams> params_;
};

}  // namespace trisect::view
