// Buffers, each with memory of its own.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::gpu {

enum class Memory {
  device,     // local to the device; the host reaches it by copies, see Staging
  addressed,  // the same, and kernels can reach it by its address, which has no limit of size
  host,       // mapped and coherent, and cached where the device offers that
};

// The device must outlive it, and work that uses it must be finished before it is destroyed.
class Buffer {
 public:
  // size: in bytes, more than 0; the content is undefined at first. It can be used as storage,
  // uniform and indirect buffer and for transfers; an addressed one also for acceleration
  // structures, if the device has ray queries. name: for messages. Throws Error if there is no
  // memory.
  Buffer(const Device& device, std::size_t size, Memory memory, const std::string& name);

  [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
  // The device address of a buffer in Memory::addressed; 0 for others.
  [[nodiscard]] VkDeviceAddress address() const { return address_; }
  // In bytes.
  [[nodiscard]] std::size_t size() const { return size_; }

  // The mapped bytes of a buffer in Memory::host; empty for others.
  [[nodiscard]] std::span<std::byte> bytes() const { return mapped_; }

 private:
  // Members are destroyed in reverse order: the buffer before its memory.
  Owned<VkDeviceMemory, vkFreeMemory> memory_;
  Owned<VkBuffer, vkDestroyBuffer> buffer_;
  std::size_t size_ = 0;
  VkDeviceAddress address_ = 0;
  std::span<std::byte> mapped_;
};

}  // namespace trisect::gpu
