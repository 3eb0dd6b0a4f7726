#include "app/dispatch/tracer_kernels.h"

#include <optional>
#include <utility>

#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/base/parallel_rows.h"
#include "app/buffers/kernels.h"
#include "app/dispatch/accel.h"

namespace trisect {
namespace {

std::vector<gpu::Specialization> constants_of(const gpu::Device& device, const BakedScene& scene,
                                              const KernelChoice& choice) {
  const bool eight_lanes = device.subgroups().certain_size() >= 8;
  return {{CONSTANT_EIGHT_LANES, eight_lanes ? 1U : 0U},
          {CONSTANT_SURFACE, scene.choice.surface},
          {CONSTANT_SHELL, scene.choice.shell},
          {CONSTANT_SOLVER, choice.solver},
          {CONSTANT_AOVS, choice.writes_aovs() ? 1U : 0U},
          {CONSTANT_COUNTS, choice.counts ? 1U : 0U},
          {CONSTANT_DIVIDED, has_divided_patches(scene) ? 1U : 0U},
          {CONSTANT_BALLS, choice.balls ? 1U : 0U},
          {CONSTANT_NONSMOOTH, has_nonsmooth(scene) ? 1U : 0U}};
}

// A kernel to make.
struct KernelOrder {
  std::string name;
  std::vector<gpu::Specialization> constants;
};

std::vector<gpu::Specialization> with(std::vector<gpu::Specialization> constants,
                                      uint32_t constant_id) {
  constants.push_back({constant_id, 1U});
  return constants;
}

// In the order of TracerKernels::kernels_.
std::vector<KernelOrder> orders_of(const KernelPlan& plan) {
  std::vector<KernelOrder> orders{{TracerKernels::kBegin, {}}, {TracerKernels::kNext, {}}};
  for (const std::string& name : plan.camera_rays) orders.push_back({name, plan.constants});
  for (const std::string& name : plan.shadow_rays) {
    orders.push_back({name, with(plan.constants, CONSTANT_SHADOWS)});
  }
  if (plan.tiles) {
    orders.push_back({TracerKernels::kProject, plan.constants});
    orders.push_back({TracerKernels::kBin, plan.constants});
    orders.push_back({TracerKernels::kBin, with(plan.constants, CONSTANT_FILLS)});
    orders.push_back({TracerKernels::kSky, plan.constants});
  }
  return orders;
}

}  // namespace

SceneBuffers::Needs needs_of(const gpu::Device& device, const KernelChoice& choice) {
  using ByAddress = SceneBuffers::ByAddress;
  const bool bvh = needs_bvh(choice.accel, choice.shadows);
  switch (choice.accel) {
    case Accel::rayquery:
      if (!device.has_ray_query()) {
        throw DeviceError(device.report().name +
                          " lacks the ray queries of --accel rayquery; use --accel bvh.");
      }
      return {ByAddress::always, bvh};
    case Accel::bvh:
      return {device.loads_fast_by_address() ? ByAddress::always : ByAddress::if_large, bvh};
    case Accel::tiles:
      if (device.subgroup_size() == 0) {
        throw DeviceError(device.report().name +
                          " lacks the subgroup operations of --accel tiles; use --accel bvh.");
      }
      return {device.loads_fast_by_address() ? ByAddress::also : ByAddress::never, bvh};
    default:
      return {ByAddress::never, bvh};
  }
}

KernelPlan plan_kernels(const gpu::Device& device, const BakedScene& scene,
                        const KernelChoice& choice, std::size_t buffer_limit) {
  const bool by_address =
      SceneBuffers::is_by_address(device, scene, buffer_limit, needs_of(device, choice));
  const auto names = [&](Accel accel) {
    const auto kernels = tracing_kernels(accel, scene.subpatches.size(),
                                         device.subgroups().certain_size(), by_address);
    return std::vector<std::string>(kernels.begin(), kernels.end());
  };
  KernelPlan plan;
  plan.constants = constants_of(device, scene, choice);
  plan.camera_rays = names(choice.accel);
  plan.tiles = choice.accel == Accel::tiles;
  // Shadow rays start at what the camera rays hit. They have no tile: with tiles they traverse the
  // BVH.
  if (choice.shadows) plan.shadow_rays = names(plan.tiles ? Accel::bvh : choice.accel);
  return plan;
}

TracerKernels::TracerKernels(const gpu::Device& device, KernelPlan plan, const KernelCode* code)
    : plan_(std::move(plan)) {
  const std::vector<KernelOrder> orders = orders_of(plan_);
  std::vector<std::optional<gpu::Kernel>> kernels(orders.size());
  parallel_chunks(orders.size(), 1, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      kernels[i].emplace(make_kernel(device, orders[i].name.c_str(), orders[i].constants, code));
    }
  });
  kernels_.reserve(kernels.size());
  for (std::optional<gpu::Kernel>& kernel : kernels) kernels_.push_back(std::move(*kernel));
}

}  // namespace trisect
