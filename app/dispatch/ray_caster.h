// Rays of any origin and direction, cast by the kernels' solvers on Vulkan.
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

// For one thread at a time; the device must outlive it.
class RayCaster {
 public:
  // What a kernel is specialised for. The first two may be true for scenes without such patches;
  // bvh must be that of all scenes that share the kernel.
  struct Needs {
    bool divided = true;    // some patches are divided into subpatches: has_divided_patches()
    bool nonsmooth = true;  // some surfaces have jumps in their tangents: has_nonsmooth()
    bool bvh = false;       // rays traverse the scene's BVH instead of the list of all subpatches
  };

  // Uploads the scene. The rays traverse its BVH if it has one. params: rank, resolution,
  // min_delta, alpha and the counts of triangles and subpatches are used, the camera is not.
  // solver: SOLVER_ROBUST needs the scene's subpatches. kernel: one of kernel_for() that several
  // scenes of the same surface and solver share; null to compile one for this scene. steps: of a
  // ray before it pauses. Throws DeviceError if the device cannot hold the scene.
  RayCaster(const gpu::Device& device, const BakedScene& scene, const TraceParams& params,
            uint solver, std::shared_ptr<const gpu::Kernel> kernel = nullptr,
            uint32_t steps = RayQueue::kSteps);

  static std::shared_ptr<const gpu::Kernel> kernel_for(const gpu::Device& device,
                                                       const SurfaceChoice& choice, uint solver,
                                                       const Needs& needs);
  // In shaders/CMakeLists.txt.
  static constexpr const char* kernel_name(bool bvh) { return bvh ? "cast_by_bvh" : "cast_rays"; }

  // The first hit of each ray, in the order of the rays, of which there may be any number. Throws
  // DeviceError if the device is lost.
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
  gpu::DescriptorSet descriptors_;
};

}  // namespace trisect
