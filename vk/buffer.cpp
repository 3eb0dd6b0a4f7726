#include "vk/buffer.h"

#include "vk/result.h"

namespace trisect::gpu {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20U;

}  // namespace

Buffer::Buffer(const Device& device, std::size_t size, Memory memory, const std::string& name)
    : size_(size) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
               VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
               VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (memory == Memory::addressed) info.usage |= VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
  if (memory == Memory::addressed && device.has_ray_query()) {
    info.usage |= VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
                  VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR;
  }
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  const auto require = [&](VkResult result) {
    if (result == VK_SUCCESS) return;
    const std::string bytes =
        size < kMiB ? std::to_string(size) + " bytes" : std::to_string(size / kMiB) + " MiB";
    fail(result, "the " + name + " buffer of " + bytes + " on " + device.report().name);
  };
  require(vkCreateBuffer(device.get(), &info, nullptr, buffer_.fill(device.get())));
  device.name(VK_OBJECT_TYPE_BUFFER, buffer_.get(), name);

  VkMemoryRequirements requirements{};
  vkGetBufferMemoryRequirements(device.get(), buffer_.get(), &requirements);
  VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  allocation.allocationSize = requirements.size;
  VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  if (memory == Memory::addressed) allocation.pNext = &flags;
  allocation.memoryTypeIndex =
      memory != Memory::host
          ? device.memory_type(requirements.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)
          : device.memory_type(
                requirements.memoryTypeBits,
                VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
  require(vkAllocateMemory(device.get(), &allocation, nullptr, memory_.fill(device.get())));
  device.name(VK_OBJECT_TYPE_DEVICE_MEMORY, memory_.get(), name);
  TRISECT_VK(vkBindBufferMemory(device.get(), buffer_.get(), memory_.get(), 0));
  if (memory == Memory::addressed) address_ = device.address_of(buffer_.get());
  if (memory == Memory::host) {
    void* address = nullptr;
    TRISECT_VK(vkMapMemory(device.get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &address));
    mapped_ = {static_cast<std::byte*>(address), size};
  }
}

}  // namespace trisect::gpu
