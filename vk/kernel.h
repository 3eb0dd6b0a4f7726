// Compute pipelines and their descriptor sets.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vk/buffer.h"
#include "vk/device.h"
#include "vk/layout.h"
#include "vk/owned.h"
#include "vk/shader_code.h"

namespace trisect::gpu {

// A compute pipeline with its layouts. The device must outlive it.
class Kernel {
 public:
  // spirv: words with the entry point "main"; constants: those not named keep their defaults; name:
  // for messages. If the kernel uses subgroup operations, its subgroups are those of
  // device.subgroups(). Throws Error if the driver cannot compile it.
  Kernel(const Device& device, std::span<const uint32_t> spirv, KernelInterface interface,
         const std::vector<Specialization>& constants, const std::string& name,
         Floats floats = Floats::exact);

  [[nodiscard]] VkPipeline pipeline() const { return pipeline_.get(); }
  [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }
  [[nodiscard]] VkDescriptorSetLayout set_layout() const { return set_layout_.get(); }
  [[nodiscard]] const KernelInterface& interface() const { return interface_; }

 private:
  KernelInterface interface_;
  SetLayout set_layout_;
  PipelineLayout layout_;
  Owned<VkPipeline, vkDestroyPipeline> pipeline_;
};

// A descriptor set with a buffer for every binding of a kernel's interface. It serves all kernels
// of that interface.
class DescriptorSet {
 public:
  // buffers: one for each binding of the interface, in its order; they must outlive the set. Throws
  // std::logic_error if their number is another, Error if there is no memory.
  DescriptorSet(const Device& device, const Kernel& kernel,
                const std::vector<const Buffer*>& buffers);

  [[nodiscard]] VkDescriptorSet get() const { return set_; }

 private:
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace trisect::gpu
