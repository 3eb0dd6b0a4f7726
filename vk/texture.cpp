#include "vk/texture.h"

#include "vk/result.h"

namespace trisect::gpu {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkImageSubresourceRange kWhole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

}  // namespace

Texture::Texture(const Device& device, uint32_t width, uint32_t height, const std::string& name)
    : width_(width), height_(height) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = kFormat;
  info.extent = {width, height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  TRISECT_VK(vkCreateImage(device.get(), &info, nullptr, image_.fill(device.get())));
  device.name(VK_OBJECT_TYPE_IMAGE, image_.get(), name);
  VkMemoryRequirements requirements{};
  vkGetImageMemoryRequirements(device.get(), image_.get(), &requirements);
  VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  allocation.allocationSize = requirements.size;
  allocation.memoryTypeIndex =
      device.memory_type(requirements.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  TRISECT_VK(vkAllocateMemory(device.get(), &allocation, nullptr, memory_.fill(device.get())));
  TRISECT_VK(vkBindImageMemory(device.get(), image_.get(), memory_.get(), 0));
  VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  view.image = image_.get();
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = kFormat;
  view.subresourceRange = kWhole;
  TRISECT_VK(vkCreateImageView(device.get(), &view, nullptr, view_.fill(device.get())));
  VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  // Not all devices can filter 32-bit floats. On those that cannot, an enlarged frame shows the
  // edges of its pixels.
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(device.physical(), kFormat, &properties);
  const bool can_filter =
      (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) != 0;
  sampler.magFilter = can_filter ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  sampler.minFilter = sampler.magFilter;
  sampler.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  sampler.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  sampler.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  TRISECT_VK(vkCreateSampler(device.get(), &sampler, nullptr, sampler_.fill(device.get())));
}

void Texture::change_layout(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to) const {
  const bool for_copy = to == VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
  barrier.srcAccessMask = for_copy ? 0 : VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = for_copy ? VK_ACCESS_TRANSFER_WRITE_BIT : VK_ACCESS_SHADER_READ_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image_.get();
  barrier.subresourceRange = kWhole;
  // The fragments of the last frame must have read the texture before it is overwritten.
  const VkPipelineStageFlags fragments = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
  const VkPipelineStageFlags transfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
  vkCmdPipelineBarrier(commands, for_copy ? fragments : transfer, for_copy ? transfer : fragments,
                       0, 0, nullptr, 0, nullptr, 1, &barrier);
}

void Texture::copy(VkCommandBuffer commands, const Buffer& from, uint32_t width,
                   uint32_t height) const {
  VkMemoryBarrier written{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  written.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  written.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                       VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &written, 0, nullptr, 0, nullptr);
  change_layout(commands, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {width, height, 1};
  vkCmdCopyBufferToImage(commands, from.get(), image_.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         1, &region);
  change_layout(commands, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

}  // namespace trisect::gpu
