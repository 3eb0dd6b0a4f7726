// The compute pipelines that trace a scene's frames. A driver may take seconds to make them, so
// scenes share them, and they can be made while another thread uses the device: creating pipelines
// and their layouts needs no lock (Vulkan 1.3, section 3.6, "Threading Behavior").
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/buffers/kernel_choice.h"
#include "app/buffers/kernel_code.h"
#include "app/buffers/scene_buffers.h"
#include "vk/kernel.h"

namespace trisect {

// Which kernels trace a scene, and what they are specialised for. Scenes of equal plans can share
// them.
struct KernelPlan {
  std::vector<gpu::Specialization> constants;
  std::vector<std::string> camera_rays;  // names: tracing_kernels()
  std::vector<std::string> shadow_rays;  // the same; none without shadows
  bool tiles = false;                    // the frame needs lists of tiles

  bool operator==(const KernelPlan&) const = default;
};

// What a tracer with this choice needs of a scene's buffers. Throws DeviceError if the device
// cannot do what the acceleration needs.
SceneBuffers::Needs needs_of(const gpu::Device& device, const KernelChoice& choice);

// buffer_limit: bytes of a buffer, at most the device's own limit. Throws as needs_of() does.
KernelPlan plan_kernels(const gpu::Device& device, const BakedScene& scene,
                        const KernelChoice& choice, std::size_t buffer_limit);

// Can be read by any thread. The device must outlive them.
class TracerKernels {
 public:
  // In shaders/CMakeLists.txt: by which a frame goes on from pass to pass without the host.
  static constexpr const char* kBegin = "begin_part";
  static constexpr const char* kNext = "next_pass";
  // By which it gets its lists of tiles.
  static constexpr const char* kProject = "project_subpatches";
  static constexpr const char* kBin = "bin_subpatches";
  static constexpr const char* kSky = "fill_sky";

  // Makes them, on all cores. code: as spirv_of() takes it. Throws DeviceError if the device cannot
  // make one.
  TracerKernels(const gpu::Device& device, KernelPlan plan, const KernelCode* code);

  [[nodiscard]] const KernelPlan& plan() const { return plan_; }

  [[nodiscard]] const gpu::Kernel& begin() const { return kernels_[0]; }
  [[nodiscard]] const gpu::Kernel& next() const { return kernels_[1]; }
  // Those of tracing_kernels(); no shadow rays without shadows.
  [[nodiscard]] std::span<const gpu::Kernel> camera_rays() const {
    return std::span(kernels_).subspan(2, plan_.camera_rays.size());
  }
  [[nodiscard]] std::span<const gpu::Kernel> shadow_rays() const {
    return std::span(kernels_).subspan(2 + plan_.camera_rays.size(), plan_.shadow_rays.size());
  }

  // Only if the plan has tiles: what projects the subpatches, counts the lists' entries, writes
  // them, and fills in the sky.
  [[nodiscard]] const gpu::Kernel& project() const { return tile_kernel(0); }
  [[nodiscard]] const gpu::Kernel& count() const { return tile_kernel(1); }
  [[nodiscard]] const gpu::Kernel& fill() const { return tile_kernel(2); }
  [[nodiscard]] const gpu::Kernel& sky() const { return tile_kernel(3); }

 private:
  [[nodiscard]] const gpu::Kernel& tile_kernel(std::size_t i) const {
    return kernels_[2 + plan_.camera_rays.size() + plan_.shadow_rays.size() + i];
  }

  KernelPlan plan_;
  // begin, next, camera rays, shadow rays, tiles.
  std::vector<gpu::Kernel> kernels_;
};

}  // namespace trisect
