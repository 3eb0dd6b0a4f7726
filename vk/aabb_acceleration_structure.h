// An acceleration structure of the device over axis-aligned boxes, for kernels with ray queries
// (VK_KHR_acceleration_structure).
#pragma once

#include <cstddef>
#include <span>

#include "vk/buffer.h"
#include "vk/commands.h"
#include "vk/device.h"

namespace trisect::gpu {

// A top level with one instance, the identity, of a bottom level with one geometry. The device must
// outlive it.
class AabbAccelerationStructure {
 public:
  // Builds it and waits until it is built. boxes: at least one; box i is primitive i of geometry 0.
  // The device must have ray queries: Device::has_ray_query(). Throws Error if there is no memory.
  AabbAccelerationStructure(const Device& device, Staging& staging, Commands& commands,
                            std::span<const VkAabbPositionsKHR> boxes);

  // The address from which a kernel constructs an accelerationStructureEXT.
  [[nodiscard]] VkDeviceAddress address() const { return top_.address; }
  // Bytes of device memory.
  [[nodiscard]] std::size_t bytes() const { return bottom_.buffer.size() + top_.buffer.size(); }

 private:
  struct Level {
    Level(const Device& device, VkAccelerationStructureTypeKHR type, std::size_t size,
          const char* name);
    ~Level();
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    Level(Level&&) = delete;
    Level& operator=(Level&&) = delete;

    const Device& device;
    Buffer buffer;
    VkAccelerationStructureKHR structure = VK_NULL_HANDLE;
    VkDeviceAddress address = 0;
  };

  Level bottom_;
  Level top_;
};

}  // namespace trisect::gpu
