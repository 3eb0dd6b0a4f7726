// What compute and graphics pipelines have in common: shader modules, layouts and descriptor sets.
// All functions throw Error if the driver fails.
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

// What a shader binds: buffers in descriptor set 0, and push constants.
struct KernelInterface {
  std::vector<Binding> bindings;
  uint32_t push_size = 0;  // bytes of the push constants
};

using ShaderModule = Owned<VkShaderModule, vkDestroyShaderModule>;
using SetLayout = Owned<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using PipelineLayout = Owned<VkPipelineLayout, vkDestroyPipelineLayout>;
using DescriptorPool = Owned<VkDescriptorPool, vkDestroyDescriptorPool>;

// How a module's operations on floats are done.
enum class Floats {
  exact,     // as they are written, see with_exact_floats() and with_float_controls()
  contract,  // as the driver likes, for measurements of what it likes
};

ShaderModule make_shader_module(const Device& device, std::span<const uint32_t> spirv,
                                Floats floats = Floats::exact);
SetLayout make_set_layout(const Device& device, const KernelInterface& interface,
                          VkShaderStageFlags stage);
PipelineLayout make_pipeline_layout(const Device& device, VkDescriptorSetLayout set,
                                    const KernelInterface& interface, VkShaderStageFlags stage);

// A pool for one descriptor set of the interface.
DescriptorPool make_pool(const Device& device, const KernelInterface& interface);
VkDescriptorSet allocate_set(const Device& device, VkDescriptorPool pool,
                             VkDescriptorSetLayout layout);

// Writes the buffers to a set: one for each binding, in the interface's order. Throws
// std::logic_error if their number is another.
void write_set(const Device& device, VkDescriptorSet set, const KernelInterface& interface,
               const std::vector<const Buffer*>& buffers);

}  // namespace trisect::gpu
