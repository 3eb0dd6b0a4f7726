#include "app/buffers/scene_buffers.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "app/bake/subpatch_boxes.h"
#include "app/buffers/buffer_limits.h"

namespace trisect {
namespace {

template <typename T>
void upload_items(gpu::Staging& staging, gpu::Commands& commands, const std::vector<T>& items,
                  gpu::Buffer& buffer) {
  if (!items.empty()) staging.upload(commands, std::as_bytes(std::span(items)), buffer);
}

uint low(VkDeviceAddress address) {
  return static_cast<uint>(address);
}
uint high(VkDeviceAddress address) {
  return static_cast<uint>(address >> 32U);
}

// How much boxes are enlarged for the rounding of a ray's points and for that of the device's own
// intersection test, as a fraction of the scene's radius: the anchors of camera rays that hit the
// scene are at most 25 radii away, whatever the field of view.
const float kBoxSlack = 16.0F * BVH_SLACK;

VkAabbPositionsKHR inflated(const SubpatchBox& box, float slack) {
  return {box.lo.x - slack, box.lo.y - slack, box.lo.z - slack,
          box.hi.x + slack, box.hi.y + slack, box.hi.z + slack};
}

}  // namespace

SceneBuffers::Placement SceneBuffers::placement_of(const gpu::Device& device,
                                                   const BakedScene& scene, std::size_t limit,
                                                   const Needs& needs) {
  const bool too_large = scene.triangles.size() * sizeof(Triangle) > limit ||
                         scene.subpatches.size() * sizeof(SubpatchBounds) > limit ||
                         (needs.bvh && scene.bvh.size() * sizeof(BvhNode) > limit);
  if (needs.by_address == ByAddress::also) return {limit, gpu::Memory::addressed, true};
  const bool by_address =
      needs.by_address == ByAddress::always ||
      (needs.by_address == ByAddress::if_large && device.has_addresses() && too_large);
  return by_address ? Placement{kNoLimit, gpu::Memory::addressed, false}
                    : Placement{limit, gpu::Memory::device, true};
}

SceneBuffers::SceneBuffers(const gpu::Device& device, const BakedScene& scene, std::size_t limit,
                           const Needs& needs)
    : SceneBuffers(device, scene, placement_of(device, scene, limit, needs), needs.bvh) {}

SceneBuffers::SceneBuffers(const gpu::Device& device, const BakedScene& scene,
                           const Placement& placement, bool with_bvh)
    : by_address_(placement.memory == gpu::Memory::addressed),
      bound_(placement.bound),
      with_bvh_(with_bvh),
      triangles_(device, triangle_bytes(device.report().name, placement.limit, scene),
                 placement.memory, "triangles"),
      subpatches_(device, subpatch_bytes(device.report().name, placement.limit, scene),
                  placement.memory, "subpatch bounds"),
      // A binding needs a buffer even if no kernel reads it: one entry.
      bvh_(device,
           with_bvh ? bvh_bytes(device.report().name, placement.limit, scene) : sizeof(BvhNode),
           placement.memory, "tree"),
      addresses_(device, sizeof(Addresses), gpu::Memory::host, "addresses"),
      unused_(device, sizeof(vec4), gpu::Memory::device, "unused") {
  if (!by_address_) return;
  const Addresses addresses{.triangles_low = low(triangles_.address()),
                            .triangles_high = high(triangles_.address()),
                            .subpatches_low = low(subpatches_.address()),
                            .subpatches_high = high(subpatches_.address()),
                            .bvh_low = low(bvh_.address()),
                            .bvh_high = high(bvh_.address())};
  std::memcpy(addresses_.bytes().data(), &addresses, sizeof(addresses));
}

template <typename Change>
void SceneBuffers::change_addresses(Change&& change) {
  Addresses addresses{};
  std::memcpy(&addresses, addresses_.bytes().data(), sizeof(addresses));
  change(addresses);
  std::memcpy(addresses_.bytes().data(), &addresses, sizeof(addresses));
}

void SceneBuffers::set_projected(const gpu::Buffer& projected) {
  change_addresses([&](Addresses& addresses) {
    addresses.projected_low = low(projected.address());
    addresses.projected_high = high(projected.address());
  });
}

void SceneBuffers::upload(gpu::Staging& staging, gpu::Commands& commands, const BakedScene& scene) {
  upload_items(staging, commands, scene.triangles, triangles_);
  upload_items(staging, commands, scene.subpatches, subpatches_);
  if (with_bvh_) upload_items(staging, commands, scene.bvh, bvh_);
}

void SceneBuffers::build_boxes(const gpu::Device& device, gpu::Staging& staging,
                               gpu::Commands& commands, const BakedScene& scene) {
  const std::vector<SubpatchBox> exact_boxes = subpatch_boxes(scene);
  float scene_radius = 0.0F;
  for (std::size_t i = 0; i < exact_boxes.size(); ++i) {
    if (scene.subpatches[i].skip > 0) continue;
    scene_radius =
        std::max(scene_radius,
                 glm::length(glm::max(glm::abs(exact_boxes[i].lo), glm::abs(exact_boxes[i].hi))));
  }
  scene_radius *= 1.0F + kBoxSlack;
  std::vector<VkAabbPositionsKHR> boxes;
  boxes.reserve(exact_boxes.size());
  for (std::size_t i = 0; i < exact_boxes.size(); ++i) {
    // A divided patch has an entry that only groups its subpatches and has no geometry of its own.
    // Vulkan ignores boxes of NaNs, but Mesa 25.0.7 then loses others too. So the entry gets a box
    // of size zero at a corner of its first subpatch, and kernels ignore hits of it.
    const glm::vec3 point = exact_boxes[i + 1 < exact_boxes.size() ? i + 1 : i].lo;
    boxes.push_back(scene.subpatches[i].skip > 0
                        ? inflated({point, point}, 0.0F)
                        : inflated(exact_boxes[i], kBoxSlack * scene_radius));
  }
  boxes_ = std::make_unique<gpu::AabbAccelerationStructure>(device, staging, commands, boxes);
  change_addresses([&](Addresses& addresses) {
    addresses.boxes_low = low(boxes_->address());
    addresses.boxes_high = high(boxes_->address());
    // The kernel clips rays to a ball of this radius: it must hold the enlarged boxes.
    addresses.scene_radius = scene_radius * (1.0F + 2.0F * kBoxSlack);
  });
}

}  // namespace trisect
