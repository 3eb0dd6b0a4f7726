#include "vk/layout.h"

#include <stdexcept>
#include <string>

#include "vk/result.h"
#include "vk/shader_code.h"

namespace trisect::gpu {

ShaderModule make_shader_module(const Device& device, std::span<const uint32_t> spirv,
                                Floats floats) {
  const ShaderCode code =
      floats == Floats::exact
          ? with_float_controls(with_exact_floats(spirv), device.capabilities().floats)
          : ShaderCode(spirv.begin(), spirv.end());
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = code.size() * sizeof(uint32_t);
  info.pCode = code.data();
  ShaderModule module;
  TRISECT_VK(vkCreateShaderModule(device.get(), &info, nullptr, module.fill(device.get())));
  return module;
}

SetLayout make_set_layout(const Device& device, const KernelInterface& interface,
                          VkShaderStageFlags stage) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  bindings.reserve(interface.bindings.size());
  for (const Binding& binding : interface.bindings) {
    bindings.push_back({binding.binding, binding.type, 1, stage, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  info.bindingCount = static_cast<uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  SetLayout layout;
  TRISECT_VK(vkCreateDescriptorSetLayout(device.get(), &info, nullptr, layout.fill(device.get())));
  return layout;
}

PipelineLayout make_pipeline_layout(const Device& device, VkDescriptorSetLayout set,
                                    const KernelInterface& interface, VkShaderStageFlags stage) {
  const VkPushConstantRange push{stage, 0, interface.push_size};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = interface.push_size > 0 ? 1 : 0;
  info.pPushConstantRanges = &push;
  PipelineLayout layout;
  TRISECT_VK(vkCreatePipelineLayout(device.get(), &info, nullptr, layout.fill(device.get())));
  return layout;
}

DescriptorPool make_pool(const Device& device, const KernelInterface& interface) {
  std::vector<VkDescriptorPoolSize> sizes;
  sizes.reserve(interface.bindings.size());
  for (const Binding& binding : interface.bindings) sizes.push_back({binding.type, 1});
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = 1;
  info.poolSizeCount = static_cast<uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  DescriptorPool pool;
  TRISECT_VK(vkCreateDescriptorPool(device.get(), &info, nullptr, pool.fill(device.get())));
  return pool;
}

VkDescriptorSet allocate_set(const Device& device, VkDescriptorPool pool,
                             VkDescriptorSetLayout layout) {
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorPool = pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  TRISECT_VK(vkAllocateDescriptorSets(device.get(), &info, &set));
  return set;
}

void write_set(const Device& device, VkDescriptorSet set, const KernelInterface& interface,
               const std::vector<const Buffer*>& buffers) {
  const std::vector<Binding>& bindings = interface.bindings;
  if (buffers.size() != bindings.size()) {
    throw std::logic_error("a set of " + std::to_string(bindings.size()) + " bindings got " +
                           std::to_string(buffers.size()) + " buffers");
  }
  std::vector<VkDescriptorBufferInfo> infos;
  infos.reserve(buffers.size());
  for (const Buffer* buffer : buffers) infos.push_back({buffer->get(), 0, VK_WHOLE_SIZE});
  std::vector<VkWriteDescriptorSet> writes;
  writes.reserve(bindings.size());
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.dstBinding = bindings[i].binding;
    write.descriptorCount = 1;
    write.descriptorType = bindings[i].type;
    write.pBufferInfo = &infos[i];
    writes.push_back(write);
  }
  vkUpdateDescriptorSets(device.get(), static_cast<uint32_t>(writes.size()), writes.data(), 0,
                         nullptr);
}

}  // namespace trisect::gpu
