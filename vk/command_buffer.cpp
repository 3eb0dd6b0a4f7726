#include "vk/command_buffer.h"

#include "vk/result.h"

namespace trisect::gpu {

CommandBuffer::CommandBuffer(const Device& device) : device_(&device) {
  VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool_info.queueFamilyIndex = device.family();
  TRISECT_VK(vkCreateCommandPool(device.get(), &pool_info, nullptr, pool_.fill(device.get())));
  VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocation.commandPool = pool_.get();
  allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocation.commandBufferCount = 1;
  TRISECT_VK(vkAllocateCommandBuffers(device.get(), &allocation, &handle_));
}

void CommandBuffer::begin() {
  TRISECT_VK(vkResetCommandPool(device_->get(), pool_.get(), 0));
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  TRISECT_VK(vkBeginCommandBuffer(handle_, &info));
}

}  // namespace trisect::gpu
