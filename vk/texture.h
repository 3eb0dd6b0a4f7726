// A frame as a texture: fragments find what lies between its pixels faster than in a buffer.
#pragma once

#include <cstdint>
#include <string>

#include "vk/buffer.h"
#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::gpu {

// Of four floats a pixel, with linear filtering where the device has it, clamped at its edges.
// Throws Error if there is no memory for it.
class Texture {
 public:
  Texture(const Device& device, uint32_t width, uint32_t height, const std::string& name);

  [[nodiscard]] uint32_t width() const { return width_; }
  [[nodiscard]] uint32_t height() const { return height_; }
  [[nodiscard]] VkImageView view() const { return view_.get(); }
  [[nodiscard]] VkSampler sampler() const { return sampler_.get(); }

  // Records a copy of the first width x height vec4s of a buffer to the upper left corner, after
  // compute shaders wrote them and before fragment shaders read. What was there is lost. Outside of
  // a render pass.
  void copy(VkCommandBuffer commands, const Buffer& from, uint32_t width, uint32_t height) const;

 private:
  void turn(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to) const;

  uint32_t width_;
  uint32_t height_;
  // Declared before the image, so freed after it.
  Owned<VkDeviceMemory, vkFreeMemory> memory_;
  Owned<VkImage, vkDestroyImage> image_;
  Owned<VkImageView, vkDestroyImageView> view_;
  Owned<VkSampler, vkDestroySampler> sampler_;
};

}  // namespace trisect::gpu
