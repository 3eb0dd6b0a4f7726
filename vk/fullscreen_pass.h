// A graphics pipeline that covers an image by one triangle; its fragment shader reads buffers and a
// texture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vk/buffer.h"
#include "vk/layout.h"
#include "vk/owned.h"
#include "vk/texture.h"

namespace trisect::gpu {

// For one thread at a time; the device must outlive it.
class FullscreenPass {
 public:
  // vertex, fragment: SPIR-V. The vertex shader gets three vertices without attributes. interface:
  // the fragment shader's buffers and push constants; it also has a texture at texture_binding.
  // Throws Error.
  FullscreenPass(const Device& device, VkRenderPass render_pass, std::span<const uint32_t> vertex,
                 std::span<const uint32_t> fragment, KernelInterface interface,
                 uint32_t texture_binding, const std::string& name);

  // Binds what the next draws read: a buffer for each binding of the interface, in its order, and
  // the texture. They must live until the next call. No submitted draw may still be executing.
  // Throws std::logic_error unless there are as many buffers as bindings.
  void bind(const std::vector<const Buffer*>& buffers, const Texture& texture);

  // Records a draw, within a render pass compatible with that of the constructor. push: the push
  // constants; throws std::logic_error unless they are as many bytes as the interface says.
  void draw(VkCommandBuffer commands, std::span<const std::byte> push) const;

 private:
  const Device* device_;
  KernelInterface interface_;
  uint32_t texture_binding_;
  SetLayout set_layout_;
  PipelineLayout layout_;
  Owned<VkPipeline, vkDestroyPipeline> pipeline_;
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace trisect::gpu
