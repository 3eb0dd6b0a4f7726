#include "app/dispatch/ray_queue.h"

#include <algorithm>
#include <stdexcept>

namespace trisect {

RayQueue::RayQueue(const gpu::Device& device, uint32_t rays, uint32_t steps)
    : rays_(rays),
      steps_(steps),
      paused_(device, std::size_t{2} * rays * sizeof(PausedRay), gpu::Memory::device,
              "paused rays"),
      queued_(device, sizeof(QueueState), gpu::Memory::host, "number of paused rays") {}

std::optional<double> RayQueue::run_all(gpu::Commands& commands,
                                        std::span<const gpu::Kernel> kernels,
                                        const gpu::DescriptorSet& descriptors, uint32_t groups,
                                        uint32_t group_rays, const KeepGoing& keep_going,
                                        const PushBytes& push_bytes) {
  if (groups > rays_ / group_rays) throw std::logic_error("more rays than the queue has places");
  double gpu_ms = 0.0;
  const bool finished =
      run_until_finished(steps_, rays_, [&](const QueuePush& queue) -> std::optional<uint32_t> {
        if (queue.pass > 0) {
          groups = (queue.resumed + group_rays - 1) / group_rays;
          if (!may_go_on(keep_going)) return std::nullopt;
        }
        QueueState state{};
        std::memcpy(queued_.bytes().data(), &state, sizeof(state));
        commands.begin();
        const std::size_t kernel = std::min<std::size_t>(queue.pass, kernels.size() - 1);
        commands.dispatch(kernels[kernel], descriptors, push_bytes(queue), groups);
        gpu_ms += commands.submit_and_wait();
        std::memcpy(&state, queued_.bytes().data(), sizeof(state));
        bytes_read_ += bytes_in(state);
        queued_rays_ += state.queued;
        return state.queued;
      });
  return finished ? std::optional(gpu_ms) : std::nullopt;
}

}  // namespace trisect
