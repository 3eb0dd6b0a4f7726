#include "app/accel.h"

#include <fmt/format.h>

#include "app/error.h"

namespace trisect {
namespace {

// Of parts in the lists of tiles: their records fill a buffer of the 128 MiB that all devices have.
constexpr std::size_t kMostParts = (std::size_t{128} << 20U) / sizeof(ViewPart);

}  // namespace

const char* accel_name(Accel accel) {
  return accel == Accel::list ? "list" : "tiles";
}

Accel chosen_accel(const RenderOptions& options, Backend backend, std::size_t parts) {
  const bool tiles = backend == Backend::vulkan && options.solver == SOLVER_ROBUST;
  if (!options.accel) return tiles && parts <= kMostParts ? Accel::tiles : Accel::list;
  if (*options.accel == Accel::tiles && !tiles) {
    throw UsageError("--accel tiles: it needs --backend vulkan and --solver robust.");
  }
  if (*options.accel == Accel::tiles && parts > kMostParts) {
    throw UsageError(
        fmt::format("--accel tiles: the patches have {} parts, more than the {} that it takes.",
                    parts, kMostParts));
  }
  return *options.accel;
}

}  // namespace trisect
