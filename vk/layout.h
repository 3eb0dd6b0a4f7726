// What compute and graphics pipelines have in common: shader modules, the layouts of descriptor set
// 0 and of push constants, and the set itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vk/buffer.h"
#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::gpu {

struct Binding {
  uint32_t binding;
  VkDescriptorType type;
};

// Descriptor set 0, push constants of push_size bytes, entry point "main".
struct KernelInterface {
  std::vector<Binding> bindings;
  uint32_t push_size = 0;
};

using ShaderModule = Owned<VkShaderModule, vkDestroyShaderModule>;
using SetLayout = Owned<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using PipelineLayout = Owned<VkPipelineLayout, vkDestroyPipelineLayout>;
using DescriptorPool = Owned<VkDescriptorPool, vkDestroyDescriptorPool>;

ShaderModule make_shader_module(const Device& device, std::span<const uint32_t> spirv);
SetLayout make_set_layout(const Device& device, const KernelInterface& interface,
                          VkShaderStageFlags stage);
PipelineLayout make_pipeline_layout(const Device& device, VkDescriptorSetLayout set,
                                    const KernelInterface& interface, VkShaderStageFlags stage);

// For one set of the interface.
DescriptorPool make_pool(const Device& device, const KernelInterface& interface);
VkDescriptorSet allocate_set(const Device& device, VkDescriptorPool pool,
                             VkDescriptorSetLayout layout);

// buffers: one for each binding, in the interface's order.
void write_set(const Device& device, VkDescriptorSet set, const KernelInterface& interface,
               const std::vector<const Buffer*>& buffers);

}  // namespace trisect::gpu
