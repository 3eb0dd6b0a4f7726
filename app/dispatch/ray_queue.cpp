#include "app/dispatch/ray_queue.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <stdexcept>

namespace trisect {

RayQueue::RayQueue(const gpu::Device& device, uint32_t rays, uint32_t steps)
    : rays_(rays),
      steps_(steps),
      paused_(device, rays * kBytes, gpu::Memory::device, "paused rays"),
      queued_(device, sizeof(QueueState), gpu::Memory::device, "state of the queue"),
      state_(device, sizeof(QueueState), gpu::Memory::host, "copy of the queue's state") {}

double RayQueue::run(gpu::Commands& commands, const gpu::Kernel& kernel,
                     const gpu::DescriptorSet& descriptors, std::span<const std::byte> push,
                     uint32_t groups, uint32_t group_rays) {
  if (groups > rays_ / group_rays) throw std::logic_error("more rays than the queue has places");
  double gpu_ms = 0.0;
  run_until_finished(steps_, rays_, [&](const QueuePass& pass) {
    if (pass.pass > 0) groups = (pass.resumed + group_rays - 1) / group_rays;
    QueueState start{};
    start.now = pass;
    commands.begin();
    commands.update(queued_, 0, std::as_bytes(std::span(&start, 1)));
    commands.dispatch(kernel, descriptors, push, groups);
    read_state(commands);
    gpu_ms += commands.submit_and_wait();
    return state().queued;
  });
  return gpu_ms;
}

void RayQueue::begin_frame(gpu::Commands& commands) const {
  commands.clear(queued_);
}

void RayQueue::begin_parts(gpu::Commands& commands) const {
  static_assert(offsetof(QueueState, is_held) == offsetof(QueueState, begun) + sizeof(uint));
  constexpr std::array<uint, 2> none{};
  commands.update(queued_, offsetof(QueueState, begun), std::as_bytes(std::span(none)));
}

void RayQueue::read_state(gpu::Commands& commands) const {
  commands.copy(queued_, 0, state_, 0, sizeof(QueueState));
}

QueueState RayQueue::state() const {
  QueueState state{};
  std::memcpy(&state, state_.bytes().data(), sizeof(state));
  return state;
}

}  // namespace trisect
