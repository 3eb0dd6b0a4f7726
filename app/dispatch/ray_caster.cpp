#include "app/dispatch/ray_caster.h"

#include <algorithm>
#include <utility>

#include "app/bake/subpatch_bounds.h"
#include "app/buffers/kernels.h"
#include "app/dispatch/submit_budget.h"

namespace trisect {
namespace {

// Rays in device memory at a time.
constexpr std::size_t kBatch = std::size_t{1} << 18U;
constexpr std::size_t kBatchBytes = kBatch * sizeof(CastRay);

}  // namespace

std::shared_ptr<const gpu::Kernel> RayCaster::kernel_for(const gpu::Device& device,
                                                         const SurfaceChoice& choice, uint solver,
                                                         const Needs& needs) {
  return std::make_shared<const gpu::Kernel>(
      make_kernel(device, kernel_name(needs.bvh),
                  {{CONSTANT_SURFACE, choice.surface},
                   {CONSTANT_SHELL, choice.shell},
                   {CONSTANT_SOLVER, solver},
                   {CONSTANT_DIVIDED, needs.divided ? 1U : 0U},
                   {CONSTANT_NONSMOOTH, needs.nonsmooth ? 1U : 0U}}));
}

RayCaster::RayCaster(const gpu::Device& device, const BakedScene& scene, const TraceParams& params,
                     uint solver, std::shared_ptr<const gpu::Kernel> kernel, uint32_t steps)
    : kernel_(kernel ? std::move(kernel)
                     : kernel_for(
                           device, scene.choice, solver,
                           {has_divided_patches(scene), has_nonsmooth(scene), !scene.bvh.empty()})),
      commands_(device),
      staging_(device, kBatchBytes),
      params_(device, sizeof(TraceParams), gpu::Memory::device, "trace parameters"),
      scene_(device, scene, device.limits().maxStorageBufferRange,
             {SceneBuffers::ByAddress::never, !scene.bvh.empty()}),
      rays_(device, kBatch * sizeof(CastRay), gpu::Memory::device, "rays"),
      hits_(device, kBatch * sizeof(CastHit), gpu::Memory::device, "hits"),
      queue_(device, kBatch, steps),
      descriptors_(device, *kernel_,
                   {&params_, &scene_.triangles(), &scene_.subpatches(), &rays_, &hits_,
                    &queue_.paused(), &queue_.queued(), &scene_.bvh()}) {
  staging_.upload(commands_, std::as_bytes(std::span(&params, 1)), params_);
  scene_.upload(staging_, commands_, scene);
}

std::vector<CastHit> RayCaster::cast(std::span<const CastRay> rays) {
  std::vector<CastHit> hits(rays.size());
  SubmitBudget budget;
  for (std::size_t first = 0; first < rays.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, rays.size() - first);
    staging_.upload(commands_, std::as_bytes(rays.subspan(first, count)), rays_);
    for (std::size_t done = 0; done < count;) {
      const auto groups = static_cast<uint32_t>(
          std::min<std::size_t>(budget.groups(), (count - done + CAST_SIZE - 1) / CAST_SIZE));
      const CastPush push{static_cast<uint>(done), static_cast<uint>(count)};
      budget.record(groups, queue_.run(commands_, *kernel_, descriptors_,
                                       std::as_bytes(std::span(&push, 1)), groups, CAST_SIZE));
      done += std::size_t{groups} * CAST_SIZE;
    }
    staging_.download(commands_, hits_,
                      std::as_writable_bytes(std::span(hits).subspan(first, count)));
  }
  return hits;
}

}  // namespace trisect
