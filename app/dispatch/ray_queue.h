// Traversals that take longer than a dispatch may: their rays pause in a queue on the device, and
// further passes resume them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "app/surface/shared.h"
#include "vk/commands.h"

namespace trisect {

// The 64-bit count of bytes read that the kernels keep in two words.
inline uint64_t bytes_in(const QueueState& state) {
  return (uint64_t{state.bytes_high} << 32U) + state.bytes_low;
}

// Calls submit(pass) first for new rays, then for the rays that paused, until none is left. submit
// runs the kernel with this pass as the queue's state and returns how many rays paused. steps: of a
// ray per pass. half: how many rays a half of the queue holds; 0 if every ray has a place of its
// own and the halves are not used.
template <typename Submit>
void run_until_finished(uint32_t steps, uint32_t half, Submit&& submit) {
  QueuePass pass{0, steps, 0, 0, half};
  while (true) {
    pass.resumed = submit(pass);
    if (pass.resumed == 0) return;
    ++pass.pass;
    std::swap(pass.from, pass.to);
  }
}

// The queue's buffers on a Vulkan device, which must outlive it. For one thread at a time.
class RayQueue {
 public:
  // For at most `rays` new rays at a time; takes kBytes of device memory for each. steps: of a
  // ray per pass; tests take fewer than kSteps so that rays pause. Throws DeviceError if there is
  // no memory.
  RayQueue(const gpu::Device& device, uint32_t rays, uint32_t steps = kSteps);

  static constexpr std::size_t kBytes = 2 * sizeof(PausedRay);

  // What kernels bind as BINDING_QUEUE and BINDING_QUEUED.
  [[nodiscard]] const gpu::Buffer& paused() const { return paused_; }
  [[nodiscard]] const gpu::Buffer& queued() const { return queued_; }
  [[nodiscard]] uint32_t rays() const { return rays_; }
  [[nodiscard]] uint32_t steps() const { return steps_; }

  // Submits `groups` workgroups of new rays, group_rays each, then those that paused, as often as
  // it takes, each pass in a submit of its own. Returns the milliseconds on the device.
  double run(gpu::Commands& commands, const gpu::Kernel& kernel,
             const gpu::DescriptorSet& descriptors, std::span<const std::byte> push,
             uint32_t groups, uint32_t group_rays);

  // Record, into a submit of a frame's passes: that it is the frame's first; that its parts begin;
  // that state() will be that of its end.
  void begin_frame(gpu::Commands& commands) const;
  void begin_parts(gpu::Commands& commands) const;
  void read_state(gpu::Commands& commands) const;

  // As of the last submit with read_state().
  [[nodiscard]] QueueState state() const;

  // llvmpipe silently ends all loops of a subgroup after 65535 iterations. At worst no two of its
  // rays, of which there are at most 16, take a step in the same iteration: 16 x 4000 is below
  // that.
  static constexpr uint32_t kSteps = 4000;

 private:
  uint32_t rays_;
  uint32_t steps_;
  gpu::Buffer paused_;  // PausedRays, two halves of rays_: one is read while the other is filled
  gpu::Buffer queued_;  // a QueueState, for the half that is filled
  gpu::Buffer state_;   // its copy for the host
};

}  // namespace trisect
