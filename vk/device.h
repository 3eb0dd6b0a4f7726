// A logical device with one compute queue, and the facts about it that the rest of the layer needs.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

#include "vk/instance.h"

namespace trisect::gpu {

class Device {
 public:
  // request: empty, a number or a part of the name, as choose_device takes it. The instance must
  // outlive the device. Throws NoDevice or Error.
  Device(const Instance& instance, const std::string& request);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  Device(Device&&) = delete;
  Device& operator=(Device&&) = delete;

  [[nodiscard]] VkDevice get() const { return device_; }
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
  void name_object(VkObjectType type, uint64_t handle, const std::string& text) const;

  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  uint32_t timestamp_bits_ = 0;
  uint32_t subgroup_size_ = 0;
  DeviceReport report_;
  VkPhysicalDeviceLimits limits_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
  PFN_vkGetBufferDeviceAddressKHR address_of_ = nullptr;
};

}  // namespace trisect::gpu
