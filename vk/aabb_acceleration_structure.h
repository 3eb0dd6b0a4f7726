// A device's own acceleration structure over boxes, for kernels with ray queries.
#pragma once

#include <cstddef>
#include <span>

#include "vk/buffer.h"
#include "vk/commands.h"
#include "vk/device.h"

namespace trisect::gpu {

class AabbAccelerationStructure {
 public:
  // Of at least one box. A ray meets box i as primitive i of geometry 0. The device must
  // have_ray_query(). Throws Error if there is no memory.
  AabbAccelerationStructure(const Device& device, Staging& staging, Commands& commands,
                            std::span<const VkAabbPositionsKHR> boxes);

  // That a kernel makes an accelerationStructureEXT of.
  [[nodiscard]] VkDeviceAddress address() const { return top_.address; }
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
