#include "app/dispatch/accel.h"

#include <fmt/format.h>

#include "app/base/error.h"
#include "app/dispatch/workgroups.h"

namespace trisect {
namespace {

// Of parts in the lists of tiles: their records fill a buffer of the 128 MiB that all devices have.
constexpr std::size_t kMostSubpatches = (std::size_t{128} << 20U) / sizeof(ProjectedSubpatch);

// Looking at all parts for every frame takes longer than the tree from so many parts a tile on:
// measured on models of up to 6272 parts, images of 200x150 to 800x600.
constexpr std::size_t kSubpatchesOfTile = 4;

}  // namespace

Accel chosen_accel(const AccelRequest& request, Backend backend, std::size_t subpatches) {
  const bool any = backend == Backend::vulkan && request.solver == SOLVER_ROBUST;
  const bool tiles = subpatches <= kMostSubpatches;
  if (!request.accel) {
    if (!any) return Accel::list;
    const std::size_t tiles_of_image =
        std::size_t{tiles_across(request.width)} * tiles_across(request.height);
    return tiles && subpatches <= kSubpatchesOfTile * tiles_of_image ? Accel::tiles : Accel::bvh;
  }
  if (*request.accel != Accel::list && !any) {
    throw UsageError(fmt::format("--accel {}: it needs --backend vulkan and --solver robust.",
                                 accel_name(*request.accel)));
  }
  if (*request.accel == Accel::tiles && !tiles) {
    throw UsageError(
        fmt::format("--accel tiles: the patches have {} parts, more than the {} that it takes.",
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

}  // namespace trisect
