// A command buffer with a pool of its own, recorded anew for every submit. The device must outlive
// it.
#pragma once

#include <vulkan/vulkan.h>

#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::gpu {

class CommandBuffer {
 public:
  // Throws Error if there is no memory.
  explicit CommandBuffer(const Device& device);

  [[nodiscard]] VkCommandBuffer get() const { return handle_; }

  // Discards what was recorded, whose execution must be finished, and begins to record for one
  // submit. Throws Error.
  void begin();

 private:
  const Device* device_;
  Owned<VkCommandPool, vkDestroyCommandPool> pool_;
  VkCommandBuffer handle_ = VK_NULL_HANDLE;
};

}  // namespace trisect::gpu
