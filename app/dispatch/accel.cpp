#include "app/accel.h"

#include <fmt/format.h>

#include "app/error.h"
#include "app/supersampling.h"
#include "app/workgroups.h"

namespace trisect {
namespace {

// Of parts in the lists of tiles: their records fill a buffer of the 128 MiB that all devices have.
constexpr std::size_t kMostParts = (std::size_t{128} << 20U) / sizeof(ViewPart);

// Looking at all parts for every frame takes longer than the tree from so many parts a tile on:
// measured on models of up to 6272 parts, images of 200x150 to 800x600.
constexpr std::size_t kPartsOfTile = 4;

}  // namespace

const char* accel_name(Accel accel) {
  switch (accel) {
    case Accel::tiles:
      return "tiles";
    case Accel::bvh:
      return "bvh";
    case Accel::rayquery:
      return "rayquery";
    default:
      return "list";
  }
}

Accel chosen_accel(const RenderOptions& options, Backend backend, std::size_t parts) {
  const bool any = backend == Backend::vulkan && options.solver == SOLVER_ROBUST;
  const bool tiles = parts <= kMostParts;
  if (!options.accel) {
    if (!any) return Accel::list;
    const uint32_t side = samples_across(options.spp);
    const std::size_t tiles_of_image =
        std::size_t{tiles_across(options.width * side)} * tiles_across(options.height * side);
    return tiles && parts <= kPartsOfTile * tiles_of_image ? Accel::tiles : Accel::bvh;
  }
  if (*options.accel != Accel::list && !any) {
    throw UsageError(fmt::format("--accel {}: it needs --backend vulkan and --solver robust.",
                                 accel_name(*options.accel)));
  }
  if (*options.accel == Accel::tiles && !tiles) {
    throw UsageError(
        fmt::format("--accel tiles: the patches have {} parts, more than the {} that it takes.",
                    parts, kMostParts));
  }
  return *options.accel;
}

bool goes_by_bvh(const RenderOptions& options, Accel accel) {
  return accel == Accel::bvh || accel == Accel::rayquery ||
         (options.shadows && accel == Accel::tiles);
}

Accel accel_at_hand(const RenderOptions& options, const BakedScene& scene) {
  const Accel accel = chosen_accel(options, Backend::vulkan, scene.cages.size());
  return goes_by_bvh(options, accel) && scene.bvh.empty() ? Accel::list : accel;
}

}  // namespace trisect
