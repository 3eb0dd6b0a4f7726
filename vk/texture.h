// A frame as a texture, which interpolates between pixels faster than a shader that reads a buffer.
#pragma once

#include <cstdint>
#include <string>

#include "vk/buffer.h"
#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::gpu {

// Four floats per pixel, filtered linearly where the device can filter such a format, else by the
// nearest pixel; clamped at the edges. The device must outlive it.
class Texture {
 public:
  // width, height: in pixels. Throws Error if there is no memory.
  Texture(const Device& device, uint32_t width, uint32_t height, const std::string& name);

  [[nodiscard]] uint32_t width() const { return width_; }
  [[nodiscard]] uint32_t height() const { return height_; }
  [[nodiscard]] VkImageView view() const { return view_.get(); }
  [[nodiscard]] VkSampler sampler() const { return sampler_.get(); }

  // Records, outside of a render pass, a copy of the first width x height vec4s of a buffer to the
  // texture's upper left corner, with the barriers between compute shaders that wrote the buffer
  // and fragment shaders that read the texture. The rest of the texture becomes undefined.
  void copy(VkCommandBuffer commands, const Buffer& from, uint32_t width, uint32_t height) const;

 private:
  // Records a barrier that changes the image's layout.
  void change_layout(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to) const;

  uint32_t width_;
  uint32_t height_;
  // Members are destroyed in reverse order: the image before its memory.
  Owned<VkDeviceMemory, vkFreeMemory> memory_;
  Owned<VkImage, vkDestroyImage> image_;
  Owned<VkImageView, vkDestroyImageView> view_;
  Owned<VkSampler, vkDestroySampler> sampler_;
};

}  // namespace trisect::gpu
