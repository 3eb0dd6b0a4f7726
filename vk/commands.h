// Recording, submitting and timing of work on the device.
#pragma once

#include <cstddef>
#include <span>

#include "vk/buffer.h"
#include "vk/command_buffer.h"
#include "vk/kernel.h"

namespace trisect::gpu {

// One submit at a time, for one thread at a time; the device must outlive it. It puts a memory
// barrier before each command, so that a command sees what earlier ones wrote. All members throw
// DeviceLost or OutOfMemory; after OutOfMemory the next begin() begins anew.
class Commands {
 public:
  explicit Commands(const Device& device);

  // Begins to record. The functions below, up to submit_and_wait(), record; what they refer to must
  // live until that returns.
  void begin();

  // Runs groups_x x groups_y workgroups of the kernel. push: the push constants; throws
  // std::logic_error unless they are as many bytes as the kernel's interface says.
  void dispatch(const Kernel& kernel, const DescriptorSet& descriptors,
                std::span<const std::byte> push, uint32_t groups_x, uint32_t groups_y = 1);

  // Builds an acceleration structure of one geometry. The device must have ray queries.
  void build(const VkAccelerationStructureBuildGeometryInfoKHR& info,
             const VkAccelerationStructureBuildRangeInfoKHR& range);

  // Sets all bytes of a buffer to 0.
  void clear(const Buffer& buffer);

  // Copies `size` bytes from one buffer to another, at these offsets in bytes.
  void copy(const Buffer& from, std::size_t from_offset, const Buffer& to, std::size_t to_offset,
            std::size_t size);

  // Submits what was recorded since begin() and waits until it is executed. Returns the time of the
  // execution in milliseconds: between two timestamps of the device, or, if its queue has none, by
  // the host's clock.
  double submit_and_wait();

 private:
  // Records a barrier: what compute shaders and transfers wrote so far is visible to later ones.
  void order_after_writes();

  const Device* device_;
  CommandBuffer commands_;
  Owned<VkFence, vkDestroyFence> fence_;
  Owned<VkQueryPool, vkDestroyQueryPool> queries_;
};

// A buffer in host memory by which bytes are copied to device memory and back, in pieces if they
// are more than fit. Each function submits and waits; `commands` must not be recording.
class Staging {
 public:
  // size: bytes of a piece.
  Staging(const Device& device, std::size_t size);

  // Copies `from` to the beginning of `to`.
  void upload(Commands& commands, std::span<const std::byte> from, const Buffer& to);
  // Copies the beginning of `from` to `to`.
  void download(Commands& commands, const Buffer& from, std::span<std::byte> to);

 private:
  Buffer buffer_;
};

}  // namespace trisect::gpu
