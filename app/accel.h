// Which acceleration a frame is traced with.
#pragma once

#include <cstddef>

#include "app/kernel_choice.h"
#include "app/options.h"

namespace trisect {

const char* accel_name(Accel accel);

// What the options ask for, or, if they leave it open, what is likely to be the fastest for a scene
// of so many parts: tiles, or the tree if the image has fewer tiles than the scene has parts,
// wherever they can be had. Throws UsageError if what is asked for cannot be.
Accel chosen_accel(const RenderOptions& options, Backend backend, std::size_t parts);

}  // namespace trisect
