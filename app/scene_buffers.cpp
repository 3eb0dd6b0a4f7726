#include "app/scene_buffers.h"

#include <cstring>
#include <span>

#include "app/buffer_limits.h"

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

}  // namespace

SceneBuffers::SceneBuffers(const gpu::Device& device, const BakedScene& scene, std::size_t limit,
                           bool addressable)
    : SceneBuffers(device, scene,
                   addressable && device.has_addresses() && !fits(scene, limit)
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
  const auto low = [](const gpu::Buffer& buffer) { return static_cast<uint>(buffer.address()); };
  const auto high = [](const gpu::Buffer& buffer) {
    return static_cast<uint>(buffer.address() >> 32U);
  };
  const Addresses addresses{low(triangles_), high(triangles_), low(cages_), high(cages_),
                            low(bvh_),       high(bvh_),       0,           0};
  std::memcpy(addresses_.bytes().data(), &addresses, sizeof(addresses));
}

void SceneBuffers::upload(gpu::Staging& staging, gpu::Commands& commands, const BakedScene& scene) {
  upload_items(staging, commands, scene.triangles, triangles_);
  upload_items(staging, commands, scene.cages, cages_);
  upload_items(staging, commands, scene.bvh, bvh_);
}

}  // namespace trisect
