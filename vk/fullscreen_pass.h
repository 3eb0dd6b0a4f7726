// A graphics pipeline that covers an image by one triangle, its fragments read from buffers.
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

class FullscreenPass {
 public:
  // The vertex shader draws three vertices without input; interface: of the fragment shader, which
  // has a texture at another binding.
  FullscreenPass(const Device& device, VkRenderPass render_pass, std::span<const uint32_t> vertex,
                 std::span<const uint32_t> fragment, KernelInterface interface,
                 uint32_t texture_binding, const std::string& name);

  // What the next draws read: a buffer for each binding of the interface, in its order, and the
  // texture. No frame that reads others may be in flight; they must live until the next call.
  void bind(const std::vector<const Buffer*>& buffers, const Texture& texture);

  // push: exactly as many bytes as the interface says.
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
