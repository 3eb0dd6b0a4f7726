// What a device's loops can hold.
#pragma once

#include "app/bake.h"
#include "vk/device.h"

namespace trisect {

// llvmpipe ends an invocation's loops, all of them together, after 65,535 iterations, and says
// nothing: the list of a larger model would lose its end. Throws gpu::Error, which says so instead.
void expect_loops_to_end(const gpu::Device& device, const BakedScene& scene, uint solver);

}  // namespace trisect
