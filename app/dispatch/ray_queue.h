// Traversals that take longer than a submit may: their rays pause in a queue on the device, and
// further submits resume them.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "app/base/keep_going.h"
#include "app/surface/shared.h"
#include "vk/commands.h"

namespace trisect {

// The 64-bit count of bytes read that the kernels keep in two words.
inline uint64_t bytes_in(const QueueState& state) {
  return (uint64_t{state.bytes_high} << 32U) + state.bytes_low;
}

// Calls submit(queue) first for new rays (queue.pass is 0), then for the rays that paused, until
// none is left. submit runs the kernel with these push constants and returns how many rays paused,
// or nothing to stop. Returns false if it stopped. steps: of a ray per submit. half: how many rays
// a half of the queue holds; 0 if every ray has a place of its own and the halves are not used.
template <typename Submit>
bool run_until_finished(uint32_t steps, uint32_t half, Submit&& submit) {
  QueuePush queue{0, steps, 0, half, 0};
  while (true) {
    const std::optional<uint32_t> paused = submit(queue);
    if (!paused) return false;
    queue.resumed = *paused;
    if (queue.resumed == 0) return true;
    ++queue.pass;
    std::swap(queue.from, queue.to);
  }
}

// The queue's buffers on a Vulkan device, which must outlive it. For one thread at a time.
class RayQueue {
 public:
  // For submits of at most `rays` new rays; takes 160 bytes of device memory for each. steps: of a
  // ray per submit; tests take fewer than kSteps so that rays pause. Throws DeviceError if there is
  // no memory.
  RayQueue(const gpu::Device& device, uint32_t rays, uint32_t steps = kSteps);

  // What kernels bind as BINDING_QUEUE and BINDING_QUEUED.
  [[nodiscard]] const gpu::Buffer& paused() const { return paused_; }
  [[nodiscard]] const gpu::Buffer& queued() const { return queued_; }

  // Submits `groups` workgroups of the first kernel, `group_rays` new rays each; then the rays that
  // paused to the second kernel, and so on, to the last kernel as often as it takes. Push: TilePush
  // or CastPush, whose member `queue` is set here. keep_going is asked between two submits. Returns
  // the milliseconds on the device, or nothing if keep_going stopped it.
  template <typename Push>
  std::optional<double> run(gpu::Commands& commands, std::span<const gpu::Kernel> kernels,
                            const gpu::DescriptorSet& descriptors, Push push, uint32_t groups,
                            uint32_t group_rays, const KeepGoing& keep_going = {}) {
    return run_all(commands, kernels, descriptors, groups, group_rays, keep_going,
                   [&push](const QueuePush& queue) {
                     push.queue = queue;
                     return std::as_bytes(std::span<const Push>(&push, 1));
                   });
  }

  // Bytes of the scene that rays have read since begin_count(), if the kernels count them
  // (KernelChoice::counts).
  void begin_count() { bytes_read_ = queued_rays_ = 0; }
  [[nodiscard]] uint64_t bytes_read() const { return bytes_read_; }
  // Rays that have paused since begin_count(), each as often as it did.
  [[nodiscard]] uint64_t queued_rays() const { return queued_rays_; }

  // llvmpipe silently ends all loops of a subgroup after 65535 iterations. At worst no two of its
  // rays, of which there are at most 16, take a step in the same iteration: 16 x 4000 is below
  // that.
  static constexpr uint32_t kSteps = 4000;

 private:
  using PushBytes = std::function<std::span<const std::byte>(const QueuePush&)>;
  std::optional<double> run_all(gpu::Commands& commands, std::span<const gpu::Kernel> kernels,
                                const gpu::DescriptorSet& descriptors, uint32_t groups,
                                uint32_t group_rays, const KeepGoing& keep_going,
                                const PushBytes& push_bytes);

  uint32_t rays_;
  uint32_t steps_;
  gpu::Buffer paused_;  // PausedRays, two halves of rays_: one is read while the other is filled
  gpu::Buffer queued_;  // a QueueState, for the half that is filled
  uint64_t bytes_read_ = 0;
  uint64_t queued_rays_ = 0;
};

}  // namespace trisect
