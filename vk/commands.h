// Recording, submitting and timing of work on the device.
#pragma once

#include <cstddef>
#include <cstdint>
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

  // The same with the VkDispatchIndirectCommand at this offset in a buffer, in bytes, a multiple of
  // 4, as it is when the command is executed.
  void dispatch_indirect(const Kernel& kernel, const DescriptorSet& descriptors,
                         std::span<const std::byte> push, const Buffer& groups, std::size_t offset);

  // Builds an acceleration structure of one geometry. The device must have ray queries.
  void build(const VkAccelerationStructureBuildGeometryInfoKHR& info,
             const VkAccelerationStructureBuildRangeInfoKHR& range);

  // Sets all bytes of a buffer to 0.
  void clear(const Buffer& buffer);

  // Sets the bytes of a buffer from `offset` on; at most 65536, their number and the offset
  // multiples of 4. They are taken now.
  void update(const Buffer& buffer, std::size_t offset, std::span<const std::byte> bytes);

  // Copies `size` bytes from one buffer to another, at these offsets in bytes.
  void copy(const Buffer& from, std::size_t from_offset, const Buffer& to, std::size_t to_offset,
            std::size_t size);

  // Submits what was recorded since begin() and waits until it is executed. Returns the time of the
  // execution in milliseconds: between two timestamps of the device, or, if its queue has none, by
  // the host's clock.
  double submit_and_wait();

  // How many submits there were.
  [[nodiscard]] uint64_t submits() const { return submits_; }

  // Begins what ms_since_mark() measures.
  void mark();

  // Of the last submit, the time in milliseconds between the mark and the end; of the whole submit
  // if it has no mark or the queue no timestamps.
  [[nodiscard]] double ms_since_mark() const { return ms_since_mark_; }

 private:
  void bind(const Kernel& kernel, const DescriptorSet& descriptors,
            std::span<const std::byte> push);
  // Records a barrier: what compute shaders and transfers wrote so far is visible to later ones
  // and to indirect dispatches.
  void order_after_writes();

  const Device* device_;
  CommandBuffer commands_;
  Owned<VkFence, vkDestroyFence> fence_;
  Owned<VkQueryPool, vkDestroyQueryPool> queries_;  // the begin, the end and the mark
  uint64_t submits_ = 0;
  bool has_mark_ = false;
  double ms_since_mark_ = 0.0;
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
