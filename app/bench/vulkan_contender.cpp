#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "app/base/stopwatch.h"
#include "app/bench/contender.h"
#include "app/buffers/kernels.h"
#include "app/cli/interrupt.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/dispatch/workgroups.h"
#include "vk/commands.h"

namespace trisect::bench {
namespace {

class ImageOnly : public Contender {
 public:
  ImageOnly(const gpu::Device& device, const TraceParams& params)
      : params_(params),
        kernel_(make_kernel(device, "clear_image", {})),
        commands_(device),
        params_buffer_(device, sizeof(TraceParams), gpu::Memory::device, "trace parameters"),
        colors_(device, std::size_t{params.width} * params.height * sizeof(vec4),
                gpu::Memory::device, "colors"),
        bound_(device, kernel_, {&params_buffer_, &colors_}) {
    gpu::Staging staging(device, sizeof(TraceParams));
    staging.upload(commands_, std::as_bytes(std::span(&params, 1)), params_buffer_);
  }

  Timing render(Frame& frame) override {
    frame.resize(params_.width, params_.height, false);
    const CpuStopwatch cpu;
    commands_.begin();
    commands_.dispatch(kernel_, bound_, {}, tiles_across(params_.width),
                       tiles_across(params_.height));
    const double ms = commands_.submit_and_wait();
    return {ms, cpu.milliseconds()};
  }

  void inspect(Frame& frame) override {
    frame.resize(params_.width, params_.height, true);
    std::fill(frame.aovs.begin(), frame.aovs.end(), PixelAovs{});
  }

  [[nodiscard]] std::size_t bytes() const override { return 0; }

 private:
  TraceParams params_;
  gpu::Kernel kernel_;
  gpu::Commands commands_;
  gpu::Buffer params_buffer_;
  gpu::Buffer colors_;
  gpu::DescriptorSet bound_;
};

}  // namespace

class Kernels {
 public:
  Kernels(const gpu::Device& device, const BakedScene& scene, const KernelChoice& choice)
      : device_(device), scene_(scene), choice_(choice) {}

  // With AOVs and counts of work, or with colours only.
  VulkanTracer& tracer(bool all, const TraceParams& params) {
    std::optional<VulkanTracer>& tracer = all ? all_ : colors_;
    if (!tracer) {
      KernelChoice choice = choice_;
      choice.aovs = all;
      choice.counts = all;
      tracer.emplace(device_, scene_, params.width, params.height, choice);
    }
    return *tracer;
  }

 private:
  const gpu::Device& device_;
  const BakedScene& scene_;
  KernelChoice choice_;
  std::optional<VulkanTracer> colors_;
  std::optional<VulkanTracer> all_;
};

namespace {

class OnVulkan : public Contender {
 public:
  OnVulkan(std::shared_ptr<Kernels> kernels, const TraceParams& params)
      : kernels_(std::move(kernels)), params_(params) {}

  Timing render(Frame& frame) override {
    VulkanTracer& tracer = kernels_->tracer(false, params_);
    const CpuStopwatch cpu;
    if (!tracer.holds_at_once(params_.width, params_.height)) {
      const double ms = finished(tracer.render(params_, frame, until_interrupted())).gpu_ms;
      return {ms, cpu.milliseconds()};
    }
    const double ms = finished(tracer.trace(params_, until_interrupted()));
    const double cpu_ms = cpu.milliseconds();
    tracer.fetch(params_, frame);
    return {ms, cpu_ms};
  }

  void inspect(Frame& frame) override {
    finished(kernels_->tracer(true, params_).render(params_, frame, until_interrupted()));
  }

  [[nodiscard]] std::size_t bytes() const override {
    return kernels_->tracer(false, params_).scene_bytes();
  }

 private:
  std::shared_ptr<Kernels> kernels_;
  TraceParams params_;
};

}  // namespace

std::unique_ptr<Contender> image_only(const gpu::Device& device, const TraceParams& params) {
  return std::make_unique<ImageOnly>(device, params);
}

std::shared_ptr<Kernels> kernels_for(const gpu::Device& device, const BakedScene& scene,
                                     const KernelChoice& choice) {
  return std::make_shared<Kernels>(device, scene, choice);
}

std::unique_ptr<Contender> on_vulkan(std::shared_ptr<Kernels> kernels, const TraceParams& params) {
  return std::make_unique<OnVulkan>(std::move(kernels), params);
}

}  // namespace trisect::bench
