#include "vk/kernel.h"

#include <string>
#include <utility>

#include "vk/result.h"

namespace trisect::gpu {

Kernel::Kernel(const Device& device, std::span<const uint32_t> spirv, KernelInterface interface,
               const std::vector<Specialization>& constants, const std::string& name, Floats floats)
    : interface_(std::move(interface)) {
  constexpr VkShaderStageFlags stage = VK_SHADER_STAGE_COMPUTE_BIT;
  set_layout_ = make_set_layout(device, interface_, stage);
  layout_ = make_pipeline_layout(device, set_layout_.get(), interface_, stage);
  const KernelFacts facts = facts_of(spirv);
  const bool specialize = device.capabilities().wants_specialized_code;
  ShaderCode code(spirv.begin(), spirv.end());
  if (specialize) {
    // Before SPIRV-Tools could fold what is to be exact.
    if (floats == Floats::exact) code = with_exact_floats(code);
    code = specialized(code, constants);
  }
  if (facts.uses_subgroups && device.capabilities().subgroups.reconverge) {
    code = with_reconverging_subgroups(code);
  }
  const ShaderModule module = make_shader_module(device, code, floats);

  std::vector<VkSpecializationMapEntry> entries;
  std::vector<uint32_t> values;
  for (const Specialization& constant : specialize ? std::vector<Specialization>{} : constants) {
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
  // Kernels without subgroup operations are left to the driver, which may know a better size.
  const SubgroupChoice& subgroups = device.subgroups();
  VkPipelineShaderStageRequiredSubgroupSizeCreateInfo size{
      VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO};
  size.requiredSubgroupSize = subgroups.size;
  if (facts.uses_subgroups && subgroups.required) info.stage.pNext = &size;
  // Vulkan allows to ask for full subgroups only where they divide the workgroup's x.
  if (facts.uses_subgroups && subgroups.full && facts.workgroup_x % subgroups.size == 0) {
    info.stage.flags |= VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
  }
  TRISECT_VK(vkCreateComputePipelines(device.get(), device.pipeline_cache(), 1, &info, nullptr,
                                      pipeline_.fill(device.get())));
  device.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, set_layout_.get(), name);
  device.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout_.get(), name);
  device.name(VK_OBJECT_TYPE_PIPELINE, pipeline_.get(), name);
}

DescriptorSet::DescriptorSet(const Device& device, const Kernel& kernel,
                             const std::vector<const Buffer*>& buffers)
    : pool_(make_pool(device, kernel.interface())),
      set_(allocate_set(device, pool_.get(), kernel.set_layout())) {
  write_set(device, set_, kernel.interface(), buffers);
}

}  // namespace trisect::gpu
