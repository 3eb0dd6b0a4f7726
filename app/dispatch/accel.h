// Which acceleration a frame is traced with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/bake/bake.h"
#include "app/buffers/kernel_choice.h"
#include "app/dispatch/backend.h"

namespace trisect {

// What decides which one.
struct AccelRequest {
  std::optional<Accel> accel;  // chosen by the program if empty
  uint solver = SOLVER_ROBUST;
  bool shadows = false;
  uint32_t width = 800;  // rays in a row and in a column of the image
  uint32_t height = 600;
};

// The one asked for, or, if that is left open, the one that is likely to be the fastest for a scene
// of so many parts: tiles, or the tree if the scene has more than four parts for each tile of the
// image, wherever they can be had. Throws UsageError if what is asked for cannot be.
Accel chosen_accel(const AccelRequest& request, Backend backend, std::size_t subpatches);

// Whether rays need the scene's bvh: those of a camera, or those of shadows beside tiles.
bool needs_bvh(Accel accel, bool shadows);

// Vulkan's for this scene as it is: chosen_accel's, or the list if that would need a tree which the
// scene does not have. Both make the same picture.
Accel accel_at_hand(const AccelRequest& request, const BakedScene& scene);

}  // namespace trisect
