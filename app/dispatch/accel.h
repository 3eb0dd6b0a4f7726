// Which acceleration a frame is traced with, and by which kernels. Pure functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "app/bake/bake.h"
#include "app/buffers/kernel_choice.h"
#include "app/dispatch/backend.h"

namespace trisect {

// What the choice of an acceleration depends on.
struct AccelRequest {
  std::optional<Accel> accel;  // the user's; empty: the program chooses
  uint solver = SOLVER_ROBUST;
  bool shadows = false;
  uint32_t width = 800;  // of the image in rays
  uint32_t height = 600;
  bool subgroups =
      true;  // the device has subgroup operations: gpu::Device::subgroup_size() is not 0
};

// The acceleration that the user asks for. If the user leaves it open, the one that is likely to be
// the fastest for a scene of so many subpatches: tiles, or the BVH if there are too many
// subpatches per tile of the image or the device lacks the subgroup operations that tiles need; the
// list where neither is possible. Throws UsageError if what the user asks for is not possible with
// this back end, solver and number of subpatches; whether the device can do it is not looked at.
Accel chosen_accel(const AccelRequest& request, Backend backend, std::size_t subpatches);

// Whether the frame's rays traverse the scene's BVH: all of them, or with tiles the shadow rays.
bool needs_bvh(Accel accel, bool shadows);

// chosen_accel() on Vulkan, or the list if that needs a BVH and the scene has none (yet). All
// accelerations make the same picture.
Accel accel_at_hand(const AccelRequest& request, const BakedScene& scene);

// The names of the kernels that trace a frame's rays: the first one traces all new rays, the
// second, if there is one, those that the first left undecided or did not finish. subpatches: of
// the scene. lanes: invocations that each subgroup has for certain. by_address: kernels reach the
// scene's buffers by their addresses.
std::vector<const char*> tracing_kernels(Accel accel, std::size_t subpatches, uint32_t lanes,
                                         bool by_address);

}  // namespace trisect
