// Walks that outlast a submit: their rays pause in a queue, and further submits go on with them.
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

inline uint64_t bytes_in(const QueueState& state) {
  return (uint64_t{state.bytes_high} << 32U) + state.bytes_low;
}

// Calls submit(queue) until no ray is left, for new rays first: it runs the kernel with these push
// constants and returns how many rays paused, or nothing to stop: then false is returned. half:
// places of a queue's half, 0 if a ray has its own.
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

class RayQueue {
 public:
  // For submits of at most `rays` new rays. Takes 96 bytes for each. steps: of a ray in one submit;
  // fewer than kSteps to test it.
  RayQueue(const gpu::Device& device, uint32_t rays, uint32_t steps = kSteps);

  // What kernels bind as BINDING_QUEUE and BINDING_QUEUED.
  [[nodiscard]] const gpu::Buffer& paused() const { return paused_; }
  [[nodiscard]] const gpu::Buffer& queued() const { return queued_; }

  // Runs `groups` workgroups of `group_rays` invocations of the first kernel, each with a new ray,
  // then submits what paused to the next one, and to the last until nothing is left. Push: of
  // shared.h with a member `queue`, which is set here. keep_going is asked between any two submits.
  // Returns milliseconds on the device; nothing if it said stop.
  template <typename Push>
  std::optional<double> run(gpu::Commands& commands, std::span<const gpu::Kernel> kernels,
                            const gpu::DescriptorSet& bound, Push push, uint32_t groups,
                            uint32_t group_rays, const KeepGoing& keep_going = {}) {
    return run_all(commands, kernels, bound, groups, group_rays, keep_going,
                   [&push](const QueuePush& queue) {
                     push.queue = queue;
                     return std::as_bytes(std::span<const Push>(&push, 1));
                   });
  }

  // What rays have read of the scene since begin_count(), if the kernels count it.
  void begin_count() { bytes_read_ = 0; }
  [[nodiscard]] uint64_t bytes_read() const { return bytes_read_; }

  // llvmpipe ends all loops of a subgroup, of at most 16 rays, after 65535 iterations.
  static constexpr uint32_t kSteps = 4000;

 private:
  using PushBytes = std::function<std::span<const std::byte>(const QueuePush&)>;
  std::optional<double> run_all(gpu::Commands& commands, std::span<const gpu::Kernel> kernels,
                                const gpu::DescriptorSet& bound, uint32_t groups,
                                uint32_t group_rays, const KeepGoing& keep_going,
                                const PushBytes& push_bytes);

  uint32_t rays_;
  uint32_t steps_;
  gpu::Buffer paused_;  // in two halves: one is read while the other is filled
  gpu::Buffer queued_;  // a QueueState, of the half that is filled
  uint64_t bytes_read_ = 0;
};

}  // namespace trisect
