#include "app/view/picture.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/buffers/buffer_limits.h"
#include "app/cli/options.h"

namespace trisect::view {
namespace {

// Size in pixels for which the buffers are made. They grow with the frames.
constexpr uint32_t kFirstSide = 64;

}  // namespace

bool Picture::prepare(const std::shared_ptr<const BakedScene>& scene, const KernelChoice& choice,
                      const std::shared_ptr<const KernelCode>& code) {
  KernelPlan plan = plan_kernels(device_, *scene, choice, device_.limits().maxStorageBufferRange);
  if (coming_ && coming_->wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    std::future<CodeKernels> ready = std::move(*coming_);
    coming_.reset();
    kernels_ = ready.get();
  }
  if (kernels_.kernels && kernels_.kernels->plan() == plan && kernels_.code == code) return true;
  // If others are being made, they are waited for first.
  if (!coming_) {
    coming_ = std::async(std::launch::async, [this, plan = std::move(plan), code] {
      return CodeKernels{code, std::make_shared<const TracerKernels>(device_, plan, code.get())};
    });
  }
  return false;
}

Picture::Use Picture::use(const std::shared_ptr<const BakedScene>& scene,
                          const KernelChoice& choice,
                          const std::shared_ptr<const KernelCode>& code) {
  if (tracer_ && scene == scene_ && choice == choice_ && code == code_) return Use::as_before;
  if (!prepare(scene, choice, code)) return Use::soon;
  tracer_ = std::make_unique<VulkanTracer>(device_, *scene, kFirstSide, kFirstSide, choice,
                                           kernels_.kernels);
  scene_ = scene;
  choice_ = choice;
  code_ = code;
  params_.reset();
  return Use::anew;
}

void Picture::wait() const {
  if (coming_) coming_->wait();
}

bool Picture::can_hold(uint32_t width, uint32_t height) const {
  return std::max(width, height) <= kLargestSide &&
         rows_in_a_band(device_.report().name, device_.limits().maxStorageBufferRange, width,
                        height, choice_.writes_aovs()) >= height;
}

bool Picture::trace(const TraceSettings& settings, const KeepGoing& keep_going) {
  const TraceParams params = make_params(*scene_, settings);
  params_.reset();
  if (!tracer_->holds_at_once(settings.width, settings.height)) {
    tracer_->resize(settings.width, settings.height);
  }
  if (!tracer_->trace(params, [&](double) { return may_go_on(keep_going); })) return false;
  params_ = params;
  return true;
}

}  // namespace trisect::view
