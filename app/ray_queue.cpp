#include "app/ray_queue.h"

#include <stdexcept>

namespace trisect {

RayQueue::RayQueue(const gpu::Device& device, uint32_t rays, uint32_t steps)
    : rays_(rays),
      steps_(steps),
      paused_(device, std::size_t{2} * rays * sizeof(PausedRay), gpu::Memory::device,
              "paused rays"),
      queued_(device, sizeof(uint32_t), gpu::Memory::host, "number of paused rays") {}

double RayQueue::run_all(gpu::Commands& commands, const gpu::Kernel& kernel,
                         const gpu::BoundBuffers& bound, uint32_t groups, uint32_t group_rays,
                         const std::function<void()>& between_submits,
                         const PushBytes& push_bytes) {
  if (groups > rays_ / group_rays) throw std::logic_error("more rays than the queue has places");
  QueuePush queue{0, steps_, 0, rays_, 0};
  double gpu_ms = 0.0;
  while (true) {
    const uint32_t none = 0;
    std::memcpy(queued_.bytes().data(), &none, sizeof(none));
    commands.begin();
    commands.dispatch(kernel, bound, push_bytes(queue), groups);
    gpu_ms += commands.submit_and_wait();
    std::memcpy(&queue.resumed, queued_.bytes().data(), sizeof(queue.resumed));
    if (queue.resumed == 0) return gpu_ms;
    ++queue.pass;
    std::swap(queue.from, queue.to);
    groups = (queue.resumed + group_rays - 1) / group_rays;
    if (between_submits) between_submits();
  }
}

}  // namespace trisect
