#include "vk/fullscreen_pass.h"

#include <array>
#include <stdexcept>
#include <utility>

#include "vk/result.h"

namespace trisect::gpu {
namespace {

VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits stage, const ShaderModule& module) {
  VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage = stage;
  info.module = module.get();
  info.pName = "main";
  return info;
}

// The interface with a binding for the texture added.
KernelInterface with_texture(KernelInterface interface, uint32_t binding) {
  interface.bindings.push_back({binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER});
  return interface;
}

}  // namespace

FullscreenPass::FullscreenPass(const Device& device, VkRenderPass render_pass,
                               std::span<const uint32_t> vertex,
                               const std::vector<ShaderCode>& fragments, KernelInterface interface,
                               uint32_t texture_binding, const std::string& name)
    : device_(&device),
      interface_(std::move(interface)),
      texture_binding_(texture_binding),
      set_layout_(make_set_layout(device, with_texture(interface_, texture_binding),
                                  VK_SHADER_STAGE_FRAGMENT_BIT)),
      layout_(make_pipeline_layout(device, set_layout_.get(), interface_,
                                   VK_SHADER_STAGE_FRAGMENT_BIT)),
      pool_(make_pool(device, with_texture(interface_, texture_binding))),
      set_(allocate_set(device, pool_.get(), set_layout_.get())) {
  const ShaderModule vertex_module = make_shader_module(device, vertex);
  const VkPipelineVertexInputStateCreateInfo input{
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.cullMode = VK_CULL_MODE_NONE;
  raster.lineWidth = 1.0F;
  VkPipelineMultisampleStateCreateInfo samples{
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineColorBlendAttachmentState blend_one{};
  blend_one.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                             VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  VkPipelineColorBlendStateCreateInfo blend{
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = 1;
  blend.pAttachments = &blend_one;
  const std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = static_cast<uint32_t>(dynamic_states.size());
  dynamic.pDynamicStates = dynamic_states.data();

  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout_.get();
  info.renderPass = render_pass;
  for (const ShaderCode& fragment : fragments) {
    const ShaderModule fragment_module = make_shader_module(device, fragment);
    const std::array stages{stage_of(VK_SHADER_STAGE_VERTEX_BIT, vertex_module),
                            stage_of(VK_SHADER_STAGE_FRAGMENT_BIT, fragment_module)};
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    auto& pipeline = pipelines_.emplace_back();
    TRISECT_VK(vkCreateGraphicsPipelines(device.get(), device.pipeline_cache(), 1, &info, nullptr,
                                         pipeline.fill(device.get())));
    device.name(VK_OBJECT_TYPE_PIPELINE, pipeline.get(), name);
  }
}

void FullscreenPass::bind(const std::vector<const Buffer*>& buffers, const Texture& texture) {
  write_set(*device_, set_, interface_, buffers);
  const VkDescriptorImageInfo image{texture.sampler(), texture.view(),
                                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  write.dstSet = set_;
  write.dstBinding = texture_binding_;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  write.pImageInfo = &image;
  vkUpdateDescriptorSets(device_->get(), 1, &write, 0, nullptr);
}

void FullscreenPass::draw(VkCommandBuffer commands, std::size_t fragment,
                          std::span<const std::byte> push) const {
  if (push.size() != interface_.push_size) {
    throw std::logic_error("a fullscreen pass with " + std::to_string(interface_.push_size) +
                           " bytes of push constants got " + std::to_string(push.size()));
  }
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.at(fragment).get());
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set_, 0,
                          nullptr);
  vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                     static_cast<uint32_t>(push.size()), push.data());
  vkCmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace trisect::gpu
