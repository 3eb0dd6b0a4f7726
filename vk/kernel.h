// A compute pipeline, and the buffers bound to it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vk/buffer.h"
#include "vk/device.h"
#include "vk/layout.h"
#include "vk/owned.h"

namespace trisect::gpu {

struct Specialization {
  uint32_t constant_id;
  uint32_t value;
};

class Kernel {
 public:
  Kernel(const Device& device, std::span<const uint32_t> spirv, KernelInterface interface,
         const std::vector<Specialization>& constants, const std::string& name);

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

// A descriptor set for a kernel. Every binding of the kernel's interface gets its buffer here,
// once.
class DescriptorSet {
 public:
  // buffers: one for each binding of the interface, in its order; they must outlive this object.
  DescriptorSet(const Device& device, const Kernel& kernel,
                const std::vector<const Buffer*>& buffers);

  [[nodiscard]] VkDescriptorSet get() const { return set_; }

 private:
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace trisect::gpu
