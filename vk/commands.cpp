#include "vk/commands.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "vk/result.h"

namespace trisect::gpu {
namespace {

// Numbers of timestamps.
constexpr uint32_t kBeginStamp = 0;
constexpr uint32_t kEndStamp = 1;
constexpr uint32_t kMarkStamp = 2;
constexpr uint32_t kTimestamps = 3;

}  // namespace

Commands::Commands(const Device& device) : device_(&device), commands_(device) {
  const VkFenceCreateInfo fence_info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  TRISECT_VK(vkCreateFence(device.get(), &fence_info, nullptr, fence_.fill(device.get())));
  if (device.timestamp_bits() > 0) {
    VkQueryPoolCreateInfo query_info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    query_info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    query_info.queryCount = kTimestamps;
    TRISECT_VK(vkCreateQueryPool(device.get(), &query_info, nullptr, queries_.fill(device.get())));
  }
}

void Commands::begin() {
  commands_.begin();
  has_mark_ = false;
  if (queries_.get() != VK_NULL_HANDLE) {
    vkCmdResetQueryPool(commands_.get(), queries_.get(), 0, kTimestamps);
    vkCmdWriteTimestamp(commands_.get(), VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, queries_.get(),
                        kBeginStamp);
  }
}

void Commands::mark() {
  if (queries_.get() == VK_NULL_HANDLE) return;
  has_mark_ = true;
  vkCmdWriteTimestamp(commands_.get(), VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_.get(),
                      kMarkStamp);
}

void Commands::bind(const Kernel& kernel, const DescriptorSet& descriptors,
                    std::span<const std::byte> push) {
  if (push.size() != kernel.interface().push_size) {
    throw std::logic_error("a kernel with " + std::to_string(kernel.interface().push_size) +
                           " bytes of push constants got " + std::to_string(push.size()));
  }
  // The kernel may read what copies and earlier dispatches wrote.
  order_after_writes();
  const VkDescriptorSet set = descriptors.get();
  vkCmdBindPipeline(commands_.get(), VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline());
  vkCmdBindDescriptorSets(commands_.get(), VK_PIPELINE_BIND_POINT_COMPUTE, kernel.layout(), 0, 1,
                          &set, 0, nullptr);
  if (!push.empty()) {
    vkCmdPushConstants(commands_.get(), kernel.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<uint32_t>(push.size()), push.data());
  }
}

void Commands::dispatch(const Kernel& kernel, const DescriptorSet& descriptors,
                        std::span<const std::byte> push, uint32_t groups_x, uint32_t groups_y) {
  bind(kernel, descriptors, push);
  vkCmdDispatch(commands_.get(), groups_x, groups_y, 1);
}

void Commands::dispatch_indirect(const Kernel& kernel, const DescriptorSet& descriptors,
                                 std::span<const std::byte> push, const Buffer& groups,
                                 std::size_t offset) {
  bind(kernel, descriptors, push);
  vkCmdDispatchIndirect(commands_.get(), groups.get(), offset);
}

void Commands::build(const VkAccelerationStructureBuildGeometryInfoKHR& info,
                     const VkAccelerationStructureBuildRangeInfoKHR& range) {
  // A build reads what was copied and built before it, and kernels of later submits read its
  // result. Builds are rare, so the barriers are as wide as possible: between everything before and
  // after.
  const auto order = [&] {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    constexpr VkPipelineStageFlags all = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    vkCmdPipelineBarrier(commands_.get(), all, all, 0, 1, &barrier, 0, nullptr, 0, nullptr);
  };
  const VkAccelerationStructureBuildRangeInfoKHR* const ranges = &range;
  order();
  device_->structures().build(commands_.get(), 1, &info, &ranges);
  order();
}

void Commands::clear(const Buffer& buffer) {
  // Earlier commands may still read what is overwritten.
  order_after_writes();
  vkCmdFillBuffer(commands_.get(), buffer.get(), 0, VK_WHOLE_SIZE, 0);
}

void Commands::update(const Buffer& buffer, std::size_t offset, std::span<const std::byte> bytes) {
  // Earlier commands may still read what is overwritten.
  order_after_writes();
  vkCmdUpdateBuffer(commands_.get(), buffer.get(), offset, bytes.size(), bytes.data());
}

void Commands::copy(const Buffer& from, std::size_t from_offset, const Buffer& to,
                    std::size_t to_offset, std::size_t size) {
  // Earlier dispatches may write the source and read the target.
  order_after_writes();
  const VkBufferCopy region{from_offset, to_offset, size};
  vkCmdCopyBuffer(commands_.get(), from.get(), to.get(), 1, &region);
}

void Commands::order_after_writes() {
  VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_SHADER_READ_BIT |
                          VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT |
                          VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
  const VkPipelineStageFlags stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                                      VK_PIPELINE_STAGE_TRANSFER_BIT |
                                      VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
  vkCmdPipelineBarrier(commands_.get(), stages, stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

double Commands::submit_and_wait() {
  // The host reads what transfers and kernels wrote to host memory, once the fence is signalled.
  VkMemoryBarrier to_host{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  to_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT;
  to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands_.get(),
                       VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                       VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, nullptr, 0, nullptr);
  if (queries_.get() != VK_NULL_HANDLE) {
    vkCmdWriteTimestamp(commands_.get(), VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_.get(),
                        kEndStamp);
  }
  TRISECT_VK(vkEndCommandBuffer(commands_.get()));

  const auto start = std::chrono::steady_clock::now();
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  const VkCommandBuffer commands = commands_.get();
  submit.pCommandBuffers = &commands;
  const VkFence fence = fence_.get();
  TRISECT_VK(vkResetFences(device_->get(), 1, &fence));
  TRISECT_VK_ON(*device_, vkQueueSubmit(device_->queue(), 1, &submit, fence));
  TRISECT_VK_WAIT(*device_, vkWaitForFences(device_->get(), 1, &fence, VK_TRUE,
                                            std::numeric_limits<uint64_t>::max()));
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
  ++submits_;
  ms_since_mark_ = elapsed.count();
  if (queries_.get() == VK_NULL_HANDLE) return elapsed.count();

  std::array<uint64_t, kTimestamps> ticks{};
  const uint32_t written = has_mark_ ? kTimestamps : kMarkStamp;
  TRISECT_VK_ON(*device_, vkGetQueryPoolResults(device_->get(), queries_.get(), 0, written,
                                                sizeof(ticks), ticks.data(), sizeof(uint64_t),
                                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  const uint32_t bits = device_->timestamp_bits();
  const uint64_t mask = bits < 64 ? (uint64_t{1} << bits) - 1 : ~uint64_t{0};
  const auto ms_since = [&](uint32_t query) {
    const auto passed = static_cast<double>((ticks[kEndStamp] - ticks[query]) & mask);
    return passed * static_cast<double>(device_->limits().timestampPeriod) * 1e-6;
  };
  ms_since_mark_ = ms_since(has_mark_ ? kMarkStamp : kBeginStamp);
  return ms_since(kBeginStamp);
}

Staging::Staging(const Device& device, std::size_t size)
    : buffer_(device, size, Memory::host, "staging") {}

void Staging::upload(Commands& commands, std::span<const std::byte> from, const Buffer& to) {
  for (std::size_t offset = 0; offset < from.size(); offset += buffer_.size()) {
    const std::size_t size = std::min(buffer_.size(), from.size() - offset);
    std::memcpy(buffer_.bytes().data(), from.data() + offset, size);
    commands.begin();
    commands.copy(buffer_, 0, to, offset, size);
    commands.submit_and_wait();
  }
}

void Staging::download(Commands& commands, const Buffer& from, std::span<std::byte> to) {
  for (std::size_t offset = 0; offset < to.size(); offset += buffer_.size()) {
    const std::size_t size = std::min(buffer_.size(), to.size() - offset);
    commands.begin();
    commands.copy(from, offset, buffer_, 0, size);
    commands.submit_and_wait();
    std::memcpy(to.data() + offset, buffer_.bytes().data(), size);
  }
}

}  // namespace trisect::gpu
