#include "app/stress/stress_backend.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <tuple>

#include "app/base/threads.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/ray_caster.h"
#include "app/dispatch/vulkan_tracer.h"

namespace trisect {

StressBackend vulkan_stress_backend(const gpu::Device& device) {
  using Key = std::tuple<uint, uint, uint>;
  using Kernels = std::map<Key, std::shared_ptr<const gpu::Kernel>>;
  StressBackend backend;
  backend.device = device.report().name;
  backend.driver = device.report().driver;
  backend.cast = [&device, kernels = std::make_shared<Kernels>()](
                     const BakedScene& scene, const TraceParams& params, uint solver,
                     std::span<const CastRay> rays) {
    auto& kernel = (*kernels)[{scene.choice.surface, scene.choice.shell, solver}];
    if (!kernel) kernel = RayCaster::kernel_for(device, scene.choice, solver, {});
    return RayCaster(device, scene, params, solver, kernel).cast(rays);
  };
  backend.render = [&device](const BakedScene& scene, const TraceParams& params,
                             const KernelChoice& choice) {
    Frame frame;
    VulkanTracer(device, scene, params.width, params.height, choice).render(params, frame);
    return frame;
  };
  return backend;
}

StressBackend cpu_stress_backend() {
  StressBackend backend;
  backend.device = fmt::format("CPU, {} threads", worker_threads());
  backend.driver = "the kernel as C++, single precision";
  backend.cast = [](const BakedScene& scene, const TraceParams& params, uint solver,
                    std::span<const CastRay> rays) {
    return cast_on_cpu(scene, params, solver, rays);
  };
  backend.render = [](const BakedScene& scene, const TraceParams& params,
                      const KernelChoice& choice) {
    Frame frame;
    trace_on_cpu(scene, params, choice, frame);
    return frame;
  };
  return backend;
}

}  // namespace trisect
