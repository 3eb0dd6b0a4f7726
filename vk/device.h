// A logical device with one compute queue, and the facts about it that the rest of the layer needs.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vk/instance.h"
#include "vk/owned.h"

namespace trisect::gpu {

class Device {
 public:
  // request: empty, a number or a part of the name, as choose_device takes it. surface: that the
  // device is to show pictures on, if any. The instance must outlive the device. Throws NoDevice or
  // Error.
  Device(const Instance& instance, const std::string& request,
         VkSurfaceKHR surface = VK_NULL_HANDLE);
  ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  Device(Device&&) = delete;
  Device& operator=(Device&&) = delete;

  [[nodiscard]] VkDevice get() const { return handle_.device; }
  [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
  [[nodiscard]] VkQueue queue() const { return queue_; }
  [[nodiscard]] uint32_t family() const { return family_; }
  [[nodiscard]] const DeviceReport& report() const { return report_; }
  [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return limits_; }

  // Invocations of a subgroup; 0 if kernels may not use subgroupBroadcast, subgroupMin and their
  // like.
  [[nodiscard]] uint32_t subgroup_size() const { return subgroup_size_; }

  // Whether kernels may reach buffers by their addresses.
  [[nodiscard]] bool has_addresses() const { return address_of_ != nullptr; }
  // Only if has_addresses().
  [[nodiscard]] VkDeviceAddress address_of(VkBuffer buffer) const;

  // Whether kernels may look for boxes by the device's own acceleration structures. The others:
  // only if they may.
  [[nodiscard]] bool has_ray_query() const { return structures_.create != nullptr; }
  struct StructureFunctions {
    PFN_vkCreateAccelerationStructureKHR create = nullptr;
    PFN_vkDestroyAccelerationStructureKHR destroy = nullptr;
    PFN_vkGetAccelerationStructureBuildSizesKHR get_sizes = nullptr;
    PFN_vkGetAccelerationStructureDeviceAddressKHR get_address = nullptr;
    PFN_vkCmdBuildAccelerationStructuresKHR build = nullptr;
  };
  [[nodiscard]] const StructureFunctions& structures() const { return structures_; }
  [[nodiscard]] VkDeviceSize scratch_alignment() const { return scratch_alignment_; }

  // What the driver keeps of the pipelines that were made, for vkCreateComputePipelines.
  [[nodiscard]] VkPipelineCache pipeline_cache() const { return pipeline_cache_.get(); }
  // The same as bytes that another run may add to its own. They are good for a device and a driver
  // of the same key, a word of letters, digits and dashes.
  [[nodiscard]] std::vector<std::byte> pipeline_data() const;
  void add_pipeline_data(std::span<const std::byte> data) const;
  [[nodiscard]] const std::string& pipeline_key() const { return pipeline_key_; }

  // Bits of a timestamp that count; 0 if the queue cannot write timestamps.
  [[nodiscard]] uint32_t timestamp_bits() const { return timestamp_bits_; }

  // The first memory type among `allowed` (a bit mask) that has `required` and, if possible,
  // `preferred`.
  [[nodiscard]] uint32_t memory_type(uint32_t allowed, VkMemoryPropertyFlags required,
                                     VkMemoryPropertyFlags preferred) const;

  // Shows the object under this name in validation messages and debuggers.
  template <typename Handle>
  void name(VkObjectType type, Handle handle, const std::string& text) const {
    name_object(type, reinterpret_cast<uint64_t>(handle), text);
  }

 private:
  void load_structure_functions();
  void name_object(VkObjectType type, uint64_t handle, const std::string& text) const;

  // A logical device is destroyed after what it made.
  struct Handle {
    VkDevice device = VK_NULL_HANDLE;
    Handle() = default;
    ~Handle() { vkDestroyDevice(device, nullptr); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle(Handle&&) = delete;
    Handle& operator=(Handle&&) = delete;
  };

  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  Handle handle_;
  Owned<VkPipelineCache, vkDestroyPipelineCache> pipeline_cache_;
  std::string pipeline_key_;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  uint32_t timestamp_bits_ = 0;
  uint32_t subgroup_size_ = 0;
  DeviceReport report_;
  VkPhysicalDeviceLimits limits_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
  StructureFunctions structures_;
  VkDeviceSize scratch_alignment_ = 1;
  PFN_vkGetBufferDeviceAddressKHR address_of_ = nullptr;
};

}  // namespace trisect::gpu
