// A baked scene in the memory of a Vulkan device.
//
// Like all that is made of a gpu::Device, for one thread at a time; the device must outlive it.
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
  // Whether kernels reach the buffers by their device addresses instead of by bindings.
  enum class ByAddress {
    never,
    if_large,  // if one of them has more bytes than a binding may have, and the device has
               // addresses
    always,    // the device must have addresses
    also,      // by both: the buffers must fit a binding, and the device must have addresses
  };

  // What the kernels need of the scene. What they do not need takes no memory.
  struct Needs {
    ByAddress by_address = ByAddress::never;
    bool bvh = false;
  };

  // Allocates the buffers. limit: the most bytes of a buffer that is bound. Throws DeviceError if a
  // buffer that must be bound is larger, or if there is no memory.
  SceneBuffers(const gpu::Device& device, const BakedScene& scene, std::size_t limit,
               const Needs& needs);

  // Copies the scene that the buffers were made for to the device; returns when it is there.
  void upload(gpu::Staging& staging, gpu::Commands& commands, const BakedScene& scene);

  // Also builds the device's own acceleration structure over the subpatches' bounding boxes. Needs
  // ByAddress::always and a device with ray queries. Throws DeviceError if there is no memory.
  void build_boxes(const gpu::Device& device, gpu::Staging& staging, gpu::Commands& commands,
                   const BakedScene& scene);

  // Bytes of device memory of all buffers and of the acceleration structure.
  [[nodiscard]] std::size_t bytes() const {
    return triangles_.size() + subpatches_.size() + bvh_.size() + addresses_.size() +
           (boxes_ ? boxes_->bytes() : 0);
  }

  [[nodiscard]] bool by_address() const { return by_address_; }

  // by_address() of the buffers that the constructor would make.
  static bool is_by_address(const gpu::Device& device, const BakedScene& scene, std::size_t limit,
                            const Needs& needs) {
    return placement_of(device, scene, limit, needs).memory == gpu::Memory::addressed;
  }

  // Lets kernels reach this buffer as that of Addresses::projected_low. Only if by_address().
  void set_projected(const gpu::Buffer& projected);

  // What kernels bind as BINDING_TRIANGLES, BINDING_SUBPATCHES, BINDING_BVH and BINDING_ADDRESSES.
  // Where the kernels go by address alone, the first three are a placeholder.
  [[nodiscard]] const gpu::Buffer& triangles() const { return bound_ ? triangles_ : unused_; }
  [[nodiscard]] const gpu::Buffer& subpatches() const { return bound_ ? subpatches_ : unused_; }
  [[nodiscard]] const gpu::Buffer& bvh() const { return bound_ ? bvh_ : unused_; }
  [[nodiscard]] const gpu::Buffer& addresses() const { return addresses_; }

 private:
  // In which memory the buffers are, and the most bytes that one of them may have there.
  struct Placement {
    std::size_t limit;
    gpu::Memory memory;
    bool bound;
  };
  static Placement placement_of(const gpu::Device& device, const BakedScene& scene,
                                std::size_t limit, const Needs& needs);
  SceneBuffers(const gpu::Device& device, const BakedScene& scene, const Placement& placement,
               bool with_bvh);

  // Calls change(addresses) with what kernels see as Addresses.
  template <typename Change>
  void change_addresses(Change&& change);

  bool by_address_;
  bool bound_;
  bool with_bvh_;
  gpu::Buffer triangles_;
  gpu::Buffer subpatches_;
  gpu::Buffer bvh_;
  gpu::Buffer addresses_;
  gpu::Buffer unused_;
  std::unique_ptr<gpu::AabbAccelerationStructure> boxes_;
};

}  // namespace trisect
