#include "vk/kernel.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "vk/result.h"

namespace trisect::gpu {

Kernel::Kernel(const Device& device, std::span<const uint32_t> spirv, KernelInterface interface,
               const std::vector<Specialization>& constants, const std::string& name)
    : interface_(std::move(interface)) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  bindings.reserve(interface_.bindings.size());
  for (const Binding& binding : interface_.bindings) {
    bindings.push_back({binding.binding, binding.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set_info.bindingCount = static_cast<uint32_t>(bindings.size());
  set_info.pBindings = bindings.data();
  TRISECT_VK(vkCreateDescriptorSetLayout(device.get(), &set_info, nullptr,
                                         set_layout_.fill(device.get())));

  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, interface_.push_size};
  const VkDescriptorSetLayout set_layout = set_layout_.get();
  VkPipelineLayoutCreateInfo layout_info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &set_layout;
  layout_info.pushConstantRangeCount = interface_.push_size > 0 ? 1 : 0;
  layout_info.pPushConstantRanges = &push;
  TRISECT_VK(
      vkCreatePipelineLayout(device.get(), &layout_info, nullptr, layout_.fill(device.get())));

  Owned<VkShaderModule, vkDestroyShaderModule> module;
  VkShaderModuleCreateInfo module_info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  module_info.codeSize = spirv.size_bytes();
  module_info.pCode = spirv.data();
  TRISECT_VK(vkCreateShaderModule(device.get(), &module_info, nullptr, module.fill(device.get())));

  std::vector<VkSpecializationMapEntry> entries;
  std::vector<uint32_t> values;
  for (const Specialization& constant : constants) {
    const auto offset = static_cast<uint32_t>(values.size() * sizeof(uint32_t));
    entries.push_back({constant.constant_id, offset, sizeof(uint32_t)});
    values.push_back(constant.value);
  }
  VkSpecializationInfo specialization{};
  specialization.mapEntryCount = static_cast<uint32_t>(entries.size());
  specialization.pMapEntries = entries.data();
  specialization.dataSize = values.size() * sizeof(uint32_t);
  specialization.pData = values.data();

  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.get();
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout_.get();
  TRISECT_VK(vkCreateComputePipelines(device.get(), VK_NULL_HANDLE, 1, &info, nullptr,
                                      pipeline_.fill(device.get())));
  device.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, set_layout, name);
  device.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout_.get(), name);
  device.name(VK_OBJECT_TYPE_PIPELINE, pipeline_.get(), name);
}

BoundBuffers::BoundBuffers(const Device& device, const Kernel& kernel,
                           const std::vector<const Buffer*>& buffers) {
  const std::vector<Binding>& bindings = kernel.interface().bindings;
  if (buffers.size() != bindings.size()) {
    throw std::logic_error("a kernel with " + std::to_string(bindings.size()) + " bindings got " +
                           std::to_string(buffers.size()) + " buffers");
  }
  std::vector<VkDescriptorPoolSize> sizes;
  sizes.reserve(bindings.size());
  for (const Binding& binding : bindings) sizes.push_back({binding.type, 1});
  VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = static_cast<uint32_t>(sizes.size());
  pool_info.pPoolSizes = sizes.data();
  TRISECT_VK(vkCreateDescriptorPool(device.get(), &pool_info, nullptr, pool_.fill(device.get())));

  const VkDescriptorSetLayout layout = kernel.set_layout();
  VkDescriptorSetAllocateInfo allocation{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocation.descriptorPool = pool_.get();
  allocation.descriptorSetCount = 1;
  allocation.pSetLayouts = &layout;
  TRISECT_VK(vkAllocateDescriptorSets(device.get(), &allocation, &set_));

  std::vector<VkDescriptorBufferInfo> infos;
  infos.reserve(buffers.size());
  for (const Buffer* buffer : buffers) infos.push_back({buffer->get(), 0, VK_WHOLE_SIZE});
  std::vector<VkWriteDescriptorSet> writes;
  writes.reserve(bindings.size());
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
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
