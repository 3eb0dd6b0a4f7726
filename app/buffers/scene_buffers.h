// A baked scene in the memory of a Vulkan device.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "app/bake/bake.h"
#include "vk/aabb_acceleration_structure.h"
#include "vk/buffer.h"
#include "vk/commands.h"

namespace trisect {

class SceneBuffers {
 public:
  // Whether kernels reach the buffers by their addresses.
  enum class ByAddress {
    never,
    if_large,  // if one of them has more than `limit` bytes, the most of a buffer that is bound
    always,
  };

  // Throws DeviceError, naming the device, if it cannot hold the scene.
  SceneBuffers(const gpu::Device& device, const BakedScene& scene, std::size_t limit,
               ByAddress by_address);

  void upload(gpu::Staging& staging, gpu::Commands& commands, const BakedScene& scene);

  // Also builds the device's own structure over the parts' boxes. Of buffers with addresses, on a
  // device with ray queries.
  void build_boxes(const gpu::Device& device, gpu::Staging& staging, gpu::Commands& commands,
                   const BakedScene& scene);

  // Of all of them.
  [[nodiscard]] std::size_t bytes() const {
    return triangles_.size() + subpatches_.size() + bvh_.size() + addresses_.size() +
           (boxes_ ? boxes_->bytes() : 0);
  }

  [[nodiscard]] bool by_address() const { return by_address_; }

  // What kernels bind as BINDING_TRIANGLES, BINDING_SUBPATCHES, BINDING_BVH and BINDING_ADDRESSES.
  [[nodiscard]] const gpu::Buffer& triangles() const { return by_address_ ? unused_ : triangles_; }
  [[nodiscard]] const gpu::Buffer& subpatches() const {
    return by_address_ ? unused_ : subpatches_;
  }
  [[nodiscard]] const gpu::Buffer& bvh() const { return by_address_ ? unused_ : bvh_; }
  [[nodiscard]] const gpu::Buffer& addresses() const { return addresses_; }

 private:
  // How kernels reach the buffers, and the most bytes that one of them may have for it.
  struct Placement {
    std::size_t limit;
    gpu::Memory memory;
  };
  SceneBuffers(const gpu::Device& device, const BakedScene& scene, const Placement& placement);

  bool by_address_;
  gpu::Buffer triangles_;
  gpu::Buffer subpatches_;
  gpu::Buffer bvh_;
  gpu::Buffer addresses_;
  gpu::Buffer unused_;
  std::unique_ptr<gpu::AabbAccelerationStructure> boxes_;
};

}  // namespace trisect
