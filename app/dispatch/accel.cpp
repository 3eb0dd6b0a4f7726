#include "app/dispatch/accel.h"

#include <fmt/format.h>

#include "app/base/error.h"
#include "app/dispatch/workgroups.h"

namespace trisect {
namespace {

// Tiles need a ProjectedSubpatch for each subpatch in one storage buffer. Vulkan guarantees
// bindings of 128 MiB (maxStorageBufferRange).
constexpr std::size_t kMostSubpatches = (std::size_t{128} << 20U) / sizeof(ProjectedSubpatch);

// Tiles project and bin all subpatches for every frame. With more subpatches per tile than this,
// the BVH is likely to be faster: measured on three models of 20,000 to 47,000 subpatches, images
// of 100x75 to 800x600, lavapipe. On Mesa 25.0.7 both take the same time at 45 to 60 (phong) or 25
// (sphere surface), on 22.3.6 at 70 and more or 50.
constexpr std::size_t kSubpatchesOfTile = 40;

// With the BVH, rays go down it in packets while neighbouring rays meet the same subpatches, else
// one by one. Measured on spheres at 800x600, lavapipe: 82,000 subpatches take the same time either
// way, 1.3 million half the time one by one.
constexpr std::size_t kMostInPackets = 150'000;

// In a packet each lane of a subgroup tests one of the eight children of a node. Subgroups of more
// than twice as many leave most lanes idle (argued, not measured).
constexpr uint32_t kFewestLanes = 8;
constexpr uint32_t kMostLanes = 16;

}  // namespace

Accel chosen_accel(const AccelRequest& request, Backend backend, std::size_t subpatches) {
  const bool can_accelerate = backend == Backend::vulkan && request.solver == SOLVER_ROBUST;
  const bool tiles_fit = subpatches <= kMostSubpatches;
  if (!request.accel) {
    if (!can_accelerate) return Accel::list;
    const std::size_t tiles_of_image =
        std::size_t{tiles_across(request.width)} * tiles_across(request.height);
    const bool tiles_pay = tiles_fit && subpatches <= kSubpatchesOfTile * tiles_of_image;
    return request.subgroups && tiles_pay ? Accel::tiles : Accel::bvh;
  }
  if (*request.accel != Accel::list && !can_accelerate) {
    throw UsageError(fmt::format("--accel {}: it needs --backend vulkan and --solver robust.",
                                 accel_name(*request.accel)));
  }
  if (*request.accel == Accel::tiles && !tiles_fit) {
    throw UsageError(fmt::format(
        "--accel tiles: the patches have {} subpatches, more than the {} that it takes.",
        subpatches, kMostSubpatches));
  }
  return *request.accel;
}

bool needs_bvh(Accel accel, bool shadows) {
  return accel == Accel::bvh || accel == Accel::rayquery || (shadows && accel == Accel::tiles);
}

Accel accel_at_hand(const AccelRequest& request, const BakedScene& scene) {
  const Accel accel = chosen_accel(request, Backend::vulkan, scene.subpatches.size());
  return needs_bvh(accel, request.shadows) && scene.bvh.empty() ? Accel::list : accel;
}

std::vector<const char*> tracing_kernels(Accel accel, std::size_t subpatches, uint32_t lanes,
                                         bool by_address) {
  switch (accel) {
    case Accel::tiles:
      if (by_address) return {"trace_tiles_at", "trace_pending_at", "trace_undecided_at"};
      return {"trace_tiles", "trace_pending", "trace_undecided"};
    case Accel::bvh: {
      const bool in_packets =
          subpatches <= kMostInPackets && lanes >= kFewestLanes && lanes <= kMostLanes;
      if (by_address) {
        return {in_packets ? "trace_packets_at" : "trace_rays_at", "trace_pending_at",
                "trace_bvh_at"};
      }
      return {in_packets ? "trace_packets" : "trace_rays", "trace_pending", "trace_bvh"};
    }
    case Accel::rayquery:
      return {"trace_query", "trace_bvh_at"};
    default:
      return {"trace_list"};
  }
}

}  // namespace trisect
