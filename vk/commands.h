// Recording, submitting and timing of work on the device. All dispatches and copies go through this
// class, which puts the barrier that orders them between any two.
#pragma once

#include <cstddef>
#include <span>

#include "vk/buffer.h"
#include "vk/command_buffer.h"
#include "vk/kernel.h"

namespace trisect::gpu {

class Commands {
 public:
  explicit Commands(const Device& device);

  void begin();

  // Runs groups_x times groups_y workgroups of the kernel. push: exactly as many bytes as its
  // interface says.
  void dispatch(const Kernel& kernel, const DescriptorSet& buffers, std::span<const std::byte> push,
                uint32_t groups_x, uint32_t groups_y = 1);

  // Builds an acceleration structure of one geometry.
  void build(const VkAccelerationStructureBuildGeometryInfoKHR& info,
             const VkAccelerationStructureBuildRangeInfoKHR& range);

  // Sets all bytes of a buffer to 0.
  void clear(const Buffer& buffer);

  // Copies the first `size` bytes of `from` to `to`, beginning at the given offsets.
  void copy(const Buffer& from, std::size_t from_offset, const Buffer& to, std::size_t to_offset,
            std::size_t size);

  // Submits what was recorded since begin() and waits for it. Returns the device's time for it in
  // milliseconds: between two timestamps, or by the host's clock if the queue has none.
  double submit_and_wait();

 private:
  // Makes what the device wrote so far visible to what it does next.
  void order_after_writes();

  const Device* device_;
  CommandBuffer commands_;
  Owned<VkFence, vkDestroyFence> fence_;
  Owned<VkQueryPool, vkDestroyQueryPool> queries_;
};

// A buffer in host memory through which bytes reach device memory and come back, in pieces if need
// be.
class Staging {
 public:
  // size: bytes moved at a time.
  Staging(const Device& device, std::size_t size);

  void upload(Commands& commands, std::span<const std::byte> from, const Buffer& to);
  void download(Commands& commands, const Buffer& from, std::span<std::byte> to);

 private:
  Buffer buffer_;
};

}  // namespace trisect::gpu
