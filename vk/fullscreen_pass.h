// Graphics pipelines that cover an image by one triangle; their fragment shaders read the same
// buffers and the same texture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vk/buffer.h"
#include "vk/layout.h"
#include "vk/owned.h"
#include "vk/shader_code.h"
#include "vk/texture.h"

namespace trisect::gpu {

// For one thread at a time; the device must outlive it.
class FullscreenPass {
 public:
  // vertex, fragments: SPIR-V; a pipeline is made for each fragment shader. The vertex shader gets
  // three vertices without attributes. interface: the fragment shaders' buffers and push constants;
  // they also have a texture at texture_binding. Throws Error.
  FullscreenPass(const Device& device, VkRenderPass render_pass, std::span<const uint32_t> vertex,
                 const std::vector<ShaderCode>& fragments, KernelInterface interface,
                 uint32_t texture_binding, const std::string& name);

  // Binds what the next draws read: a buffer for each binding of the interface, in its order, and
  // the texture. They must live until the next call. No submitted draw may still be executing.
  // Throws std::logic_error unless there are as many buffers as bindings.
  void bind(const std::vector<const Buffer*>& buffers, const Texture& texture);

  // Records a draw, within a render pass compatible with that of the constructor. fragment: the
  // number of the fragment shader. push: the push constants; throws std::logic_error unless they
  // are as many bytes as the interface says.
  void draw(VkCommandBuffer commands, std::size_t fragment, std::span<const std::byte> push) const;

 private:
  const Device* device_;
  KernelInterface interface_;
  uint32_t texture_binding_;
  SetLayout set_layout_;
  PipelineLayout layout_;
  std::vector<Owned<VkPipeline, vkDestroyPipeline>> pipelines_;
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace trisect::gpu
