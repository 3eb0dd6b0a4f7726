// Which acceleration a frame is traced with.
#pragma once

#include <cstddef>

#include "app/bake.h"
#include "app/kernel_choice.h"
#include "app/options.h"

namespace trisect {

const char* accel_name(Accel accel);

// What the options ask for, or, if they leave it open, what is likely to be the fastest for a scene
// of so many parts: tiles, or the tree if the scene has more than three parts for each tile of the
// image, wherever they can be had. Throws UsageError if what is asked for cannot be.
Accel chosen_accel(const RenderOptions& options, Backend backend, std::size_t parts);

// Whether rays go by the scene's bvh: those of a camera, or those of shadows beside tiles.
bool goes_by_bvh(const RenderOptions& options, Accel accel);

// The way that Vulkan goes with this scene as it is: chosen_accel's, or the list if that would need
// a tree which the scene does not have. Both make the same picture.
Accel accel_at_hand(const RenderOptions& options, const BakedScene& scene);

}  // namespace trisect
