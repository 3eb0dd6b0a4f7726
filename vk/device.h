// A logical device with one queue, and the properties that the rest of the layer needs.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vk/instance.h"
#include "vk/owned.h"

namespace trisect::gpu {

// All that is made of a device must be destroyed before it. A device and what is made of it belong
// to one thread at a time, because they share its queue and its pipeline cache, unless a function
// says otherwise; several devices can be used by as many threads.
class Device {
 public:
  // request: which device, as choose_device() takes it. surface: a window's, on which the device
  // will present; the queue then has graphics too. subgroup_size: as choose_subgroups() takes it.
  // The instance must outlive the device. Throws NoDevice if no device fits, Error if the driver
  // fails or the device does not let kernels ask for that size of subgroups.
  Device(const Instance& instance, const std::string& request,
         VkSurfaceKHR surface = VK_NULL_HANDLE,
         std::optional<uint32_t> subgroup_size = std::nullopt);
  ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  Device(Device&&) = delete;
  Device& operator=(Device&&) = delete;

  [[nodiscard]] VkDevice get() const { return handle_.device; }
  // As gpu::check() for calls that fail on a lost device; DeviceLost says what the driver reports
  // (VK_EXT_device_fault).
  void check(VkResult result, const char* call) const;
  // The same for calls that wait. Before it throws it waits until the device executes nothing any
  // more: what was submitted may then be destroyed.
  void check_wait(VkResult result, const char* call) const;
  [[nodiscard]] VkPhysicalDevice physical() const { return capabilities_.device; }
  [[nodiscard]] VkQueue queue() const { return queue_; }
  // The queue's family.
  [[nodiscard]] uint32_t family() const { return family_; }
  [[nodiscard]] const DeviceReport& report() const { return report_; }
  [[nodiscard]] const Capabilities& capabilities() const { return capabilities_; }
  [[nodiscard]] const VkPhysicalDeviceLimits& limits() const {
    return capabilities_.properties.limits;
  }

  // The subgroups of kernels that use their operations.
  [[nodiscard]] const SubgroupChoice& subgroups() const { return subgroups_; }
  // Invocations per subgroup; 0 if compute shaders lack the vote, ballot or arithmetic operations
  // of subgroups.
  [[nodiscard]] uint32_t subgroup_size() const { return subgroups_.size; }

  // Whether it is processors: kernels run on threads of the host.
  [[nodiscard]] bool is_processor() const {
    return capabilities_.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  }

  // Whether kernels can reach buffers by their addresses.
  [[nodiscard]] bool has_addresses() const { return address_of_ != nullptr; }
  // Whether kernels should load by addresses what they could load from bindings.
  [[nodiscard]] bool loads_fast_by_address() const {
    return has_addresses() && capabilities_.loads_fast_by_address;
  }
  // The buffer must have been made for it. Only if has_addresses().
  [[nodiscard]] VkDeviceAddress address_of(VkBuffer buffer) const;

  // Whether kernels can trace rays by acceleration structures (VK_KHR_ray_query). structures() and
  // scratch_alignment() are valid only if they can.
  [[nodiscard]] bool has_ray_query() const { return structures_.create != nullptr; }
  struct StructureFunctions {
    PFN_vkCreateAccelerationStructureKHR create = nullptr;
    PFN_vkDestroyAccelerationStructureKHR destroy = nullptr;
    PFN_vkGetAccelerationStructureBuildSizesKHR get_sizes = nullptr;
    PFN_vkGetAccelerationStructureDeviceAddressKHR get_address = nullptr;
    PFN_vkCmdBuildAccelerationStructuresKHR build = nullptr;
  };
  [[nodiscard]] const StructureFunctions& structures() const { return structures_; }
  [[nodiscard]] VkDeviceSize scratch_alignment() const { return capabilities_.scratch_alignment; }

  // The cache of compiled pipelines that all pipelines of this device are made with.
  [[nodiscard]] VkPipelineCache pipeline_cache() const { return pipeline_cache_.get(); }
  // The cache's content, which a later run can add to its own cache if the device and the driver
  // have the same pipeline_key(): hexadecimal digits and dashes, fit for a file name.
  [[nodiscard]] std::vector<std::byte> pipeline_data() const;
  void add_pipeline_data(std::span<const std::byte> data) const;
  [[nodiscard]] const std::string& pipeline_key() const { return pipeline_key_; }

  // Valid bits of a timestamp; 0 if the queue cannot write timestamps.
  [[nodiscard]] uint32_t timestamp_bits() const { return timestamp_bits_; }

  // The index of the first memory type among `allowed` (a bit mask) that has the properties
  // `required` and, if there is such a type, also `preferred`. Throws Error if none has those
  // required.
  [[nodiscard]] uint32_t memory_type(uint32_t allowed, VkMemoryPropertyFlags required,
                                     VkMemoryPropertyFlags preferred) const;

  // Gives an object a name for validation messages and debuggers, if the instance can.
  template <typename Handle>
  void name(VkObjectType type, Handle handle, const std::string& text) const {
    name_object(type, reinterpret_cast<uint64_t>(handle), text);
  }

 private:
  void create(std::span<const char* const> surface_extensions);
  void load_functions(bool can_name_objects);
  void name_object(VkObjectType type, uint64_t handle, const std::string& text) const;

  // Declared before the objects that the device made, so that it is destroyed after them.
  struct Handle {
    VkDevice device = VK_NULL_HANDLE;
    Handle() = default;
    ~Handle() { vkDestroyDevice(device, nullptr); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle(Handle&&) = delete;
    Handle& operator=(Handle&&) = delete;
  };

  Capabilities capabilities_;
  SubgroupChoice subgroups_;
  Handle handle_;
  Owned<VkPipelineCache, vkDestroyPipelineCache> pipeline_cache_;
  std::string pipeline_key_;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  uint32_t timestamp_bits_ = 0;
  DeviceReport report_;
  VkPhysicalDeviceMemoryProperties memory_{};
  PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
  PFN_vkGetDeviceFaultInfoEXT get_fault_ = nullptr;
  StructureFunctions structures_;
  PFN_vkGetBufferDeviceAddress address_of_ = nullptr;
};

// TRISECT_VK for calls that fail on a lost device, and for those of them that wait.
#define TRISECT_VK_ON(device, call) (device).check((call), #call)
#define TRISECT_VK_WAIT(device, call) (device).check_wait((call), #call)

}  // namespace trisect::gpu
