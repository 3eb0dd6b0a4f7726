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
         scene.cages.size() * sizeof(Cage) <= limit && scene.bvh.size() * sizeof(BvhEntry) <= limit;
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

VkAabbPositionsKHR widened(const PartBox& box, float slack) {
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
              ? Reach{kNoLimit, gpu::Memory::addressed}
              : Reach{limit, gpu::Memory::device}) {}

SceneBuffers::SceneBuffers(const gpu::Device& device, const BakedScene& scene, const Reach& reach)
    : by_address_(reach.memory == gpu::Memory::addressed),
      triangles_(device, triangle_bytes(device.report().name, reach.limit, scene), reach.memory,
                 "triangles"),
      cages_(device, cage_bytes(device.report().name, reach.limit, scene), reach.memory, "cages"),
      bvh_(device, bvh_bytes(device.report().name, reach.limit, scene), reach.memory, "tree"),
      addresses_(device, sizeof(Addresses), gpu::Memory::host, "addresses"),
      unused_(device, sizeof(vec4), gpu::Memory::device, "unused") {
  if (!by_address_) return;
  const Addresses addresses{.triangles_low = low(triangles_.address()),
                            .triangles_high = high(triangles_.address()),
                            .cages_low = low(cages_.address()),
                            .cages_high = high(cages_.address()),
                            .bvh_low = low(bvh_.address()),
                            .bvh_high = high(bvh_.address())};
  std::memcpy(addresses_.bytes().data(), &addresses, sizeof(addresses));
}

void SceneBuffers::upload(gpu::Staging& staging, gpu::Commands& commands, const BakedScene& scene) {
  upload_items(staging, commands, scene.triangles, triangles_);
  upload_items(staging, commands, scene.cages, cages_);
  upload_items(staging, commands, scene.bvh, bvh_);
}

void SceneBuffers::build_boxes(const gpu::Device& device, gpu::Staging& staging,
                               gpu::Commands& commands, const BakedScene& scene) {
  const std::vector<PartBox> parts = part_boxes(scene);
  float reach = 0.0F;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (scene.cages[i].skip > 0) continue;
    reach = std::max(reach, glm::length(glm::max(glm::abs(parts[i].lo), glm::abs(parts[i].hi))));
  }
  reach *= 1.0F + kBoxSlack;
  std::vector<VkAabbPositionsKHR> boxes;
  boxes.reserve(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    // A group has no part of its own. Boxes that are not numbers count as none, but Mesa 25.0.7
    // loses others beside them; kernels pass by a point among the group's parts.
    const glm::vec3 point = parts[i + 1 < parts.size() ? i + 1 : i].lo;
    boxes.push_back(scene.cages[i].skip > 0 ? widened({point, point}, 0.0F)
                                            : widened(parts[i], kBoxSlack * reach));
  }
  boxes_ = std::make_unique<gpu::BoxStructure>(device, staging, commands, boxes);
  Addresses addresses{};
  std::memcpy(&addresses, addresses_.bytes().data(), sizeof(addresses));
  addresses.boxes_low = low(boxes_->address());
  addresses.boxes_high = high(boxes_->address());
  // Beyond the enlarged boxes.
  addresses.reach = reach * (1.0F + 2.0F * kBoxSlack);
  std::memcpy(addresses_.bytes().data(), &addresses, sizeof(addresses));
}

}  // namespace trisect
