// Device memory with a buffer over it, and the staging buffer that moves bytes between host and
// device.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::gpu {

enum class Memory {
  device,     // fast for the device; reached from the host through Staging
  addressed,  // the same, and kernels reach it by its address, of whatever size it is
  host,       // mapped, coherent, cached where the device offers that
};

class Buffer {
 public:
  // A buffer of `size` bytes (more than 0) for storage, uniform and transfer use, never shared.
  // Throws Error if there is no memory for it.
  Buffer(const Device& device, std::size_t size, Memory memory, const std::string& name);

  [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
  // Of an addressed buffer.
  [[nodiscard]] VkDeviceAddress address() const { return address_; }
  [[nodiscard]] std::size_t size() const { return size_; }

  // The mapped bytes of a buffer in host memory, empty for one in device memory.
  [[nodiscard]] std::span<std::byte> bytes() const { return mapped_; }

 private:
  // Declared before the buffer, so freed after it.
  Owned<VkDeviceMemory, vkFreeMemory> memory_;
  Owned<VkBuffer, vkDestroyBuffer> buffer_;
  std::size_t size_ = 0;
  VkDeviceAddress address_ = 0;
  std::span<std::byte> mapped_;
};

}  // namespace trisect::gpu
