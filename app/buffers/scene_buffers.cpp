#include "app/buffers/scene_buffers.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "app/bake/subpatch_boxes.h"
#include "app/buffers/buffer_limits.h"

namespace trisect {
namespace {

bool fits(const BakedScene& scene, std::size_t limit) {
  return scene.triangles.size() * sizeof(Triangle) <= limit &&
         scene.subpatches.size() * sizeof(SubpatchBounds) <= limit &&
         scene.bvh.size() * sizeof(BvhEntry) <= limit;
}

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

// By how much boxes are enlarged for rays whose points round, and for what the device's own
// arithmetic may lose, over the scene's reach: rays of a camera that hit the scene come from
// points at most 25 times as far away, whatever the field of view.
const float kBoxSlack = 16.0F * BVH_SLACK;

VkAabbPositionsKHR inflated(const SubpatchBox& box, float slack) {
  return {box.lo.x - slack, box.lo.y - slack, box.lo.z - slack,
          box.hi.x + slack, box.hi.y + slack, box.hi.z + slack};
}

}  // namespace

SceneBuffers::SceneBuffers(const gpu::Device& device, const BakedScene& scene, std::size_t limit,
                           ByAddress by_address)
    : SceneBuffers(
          device, scene,
          by_address == ByAddress::always || (by_address == ByAddress::if_large &&
                                              device.has_addresses() && !fits(scene, limit))
              ? Placement{kNoLimit, gpu::Memory::addressed}
              : Placement{limit, gpu::Memory::device}) {}

SceneBuffers::SceneBuffers(const gpu::Device& device, const BakedScene& scene,
                           const Placement& placement)
    : by_address_(placement.memory == gpu::Memory::addressed),
      triangles_(device, triangle_bytes(device.report().name, placement.limit, scene),
                 placement.memory, "triangles"),
      subpatches_(device, subpatch_bytes(device.report().name, placement.limit, scene),
                  placement.memory, "cages"),
      bvh_(device, bvh_bytes(device.report().name, placement.limit, scene), placement.memory,
           "tree"),
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

void SceneBuffers::upload(gpu::Staging& staging, gpu::Commands& commands, const BakedScene& scene) {
  upload_items(staging, commands, scene.triangles, triangles_);
  upload_items(staging, commands, scene.subpatches, subpatches_);
  upload_items(staging, commands, scene.bvh, bvh_);
}

void SceneBuffers::build_boxes(const gpu::Device& device, gpu::Staging& staging,
                               gpu::Commands& commands, const BakedScene& scene) {
  const std::vector<SubpatchBox> subpatches = subpatch_boxes(scene);
  float scene_radius = 0.0F;
  for (std::size_t i = 0; i < subpatches.size(); ++i) {
    if (scene.subpatches[i].skip > 0) continue;
    scene_radius =
        std::max(scene_radius,
                 glm::length(glm::max(glm::abs(subpatches[i].lo), glm::abs(subpatches[i].hi))));
  }
  scene_radius *= 1.0F + kBoxSlack;
  std::vector<VkAabbPositionsKHR> boxes;
  boxes.reserve(subpatches.size());
  for (std::size_t i = 0; i < subpatches.size(); ++i) {
    // A group has no part of its own. Boxes that are not numbers count as none, but Mesa 25.0.7
    // loses others beside them; kernels pass by a point among the group's parts.
    const glm::vec3 point = subpatches[i + 1 < subpatches.size() ? i + 1 : i].lo;
    boxes.push_back(scene.subpatches[i].skip > 0
                        ? inflated({point, point}, 0.0F)
                        : inflated(subpatches[i], kBoxSlack * scene_radius));
  }
  boxes_ = std::make_unique<gpu::AabbAccelerationStructure>(device, staging, commands, boxes);
  Addresses addresses{};
  std::memcpy(&addresses, addresses_.bytes().data(), sizeof(addresses));
  addresses.boxes_low = low(boxes_->address());
  addresses.boxes_high = high(boxes_->address());
  // Beyond the enlarged boxes.
  addresses.scene_radius = scene_radius * (1.0F + 2.0F * kBoxSlack);
  std::memcpy(addresses_.bytes().data(), &addresses, sizeof(addresses));
}

}  // namespace trisect
