// A command buffer with a pool of its own, recorded anew for every submit.
#pragma once

#include <vulkan/vulkan.h>

#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::gpu {

class CommandBuffer {
 public:
  explicit CommandBuffer(const Device& device);

  [[nodiscard]] VkCommandBuffer get() const { return handle_; }

  // Forgets what was recorded, which must not be in use any more, and begins to record for one
  // submit.
  void begin();

 private:
  const Device* device_;
  Owned<VkCommandPool, vkDestroyCommandPool> pool_;
  VkCommandBuffer handle_ = VK_NULL_HANDLE;
};

}  // namespace trisect::gpu
