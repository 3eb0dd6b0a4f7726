// Rays of any origin and direction through the kernel's solvers, on Vulkan.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "app/bake/bake.h"
#include "app/buffers/scene_buffers.h"
#include "app/dispatch/ray_queue.h"
#include "app/surface/shared.h"
#include "vk/commands.h"

namespace trisect {

class RayCaster {
 public:
  // What a kernel must be made for: divided patches (has_divided_patches), parts with kinks
  // (has_nonsmooth), and whether rays go by a bvh, which all of its scenes then need.
  struct Needs {
    bool groups = true;
    bool kinks = true;
    bool bvh = false;
  };

  // params: rank, resolution, min_delta, alpha and the counts of triangles and cages; its camera is
  // not used. solver: SOLVER_ROBUST needs the scene's cages. Throws DeviceError if the device
  // cannot hold the scene. If the scene has a bvh rays go by it, else through every patch. kernel:
  // one of kernel_for(device, scene.choice, solver, needs) that several scenes share, `needs` of
  // all of them; without one the scene's own is compiled.
  RayCaster(const gpu::Device& device, const BakedScene& scene, const TraceParams& params,
            uint solver, std::shared_ptr<const gpu::Kernel> kernel = nullptr,
            uint32_t steps = RayQueue::kSteps);
  static std::shared_ptr<const gpu::Kernel> kernel_for(const gpu::Device& device,
                                                       const SurfaceChoice& choice, uint solver,
                                                       const Needs& needs);

  // One hit for each ray.
  std::vector<CastHit> cast(std::span<const CastRay> rays);

 private:
  std::shared_ptr<const gpu::Kernel> kernel_;
  gpu::Commands commands_;
  gpu::Staging staging_;
  gpu::Buffer params_;
  SceneBuffers scene_;
  gpu::Buffer rays_;
  gpu::Buffer hits_;
  RayQueue queue_;
  gpu::DescriptorSet bound_;
};

}  // namespace trisect
