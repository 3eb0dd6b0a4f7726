#include "vk/device.h"

#include <vector>

#include "vk/result.h"

namespace trisect::gpu {

Device::Device(const Instance& instance, const std::string& request) {
  const std::vector<DeviceReport> reports = instance.reports();
  const std::size_t index = choose_device(reports, request);
  const VkPhysicalDevice physical = instance.physical_devices()[index];
  report_ = reports[index];
  family_ = static_cast<uint32_t>(compute_family(physical));

  VkPhysicalDeviceSubgroupProperties subgroups{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  properties.pNext = &subgroups;
  vkGetPhysicalDeviceProperties2(physical, &properties);
  limits_ = properties.properties.limits;
  constexpr VkSubgroupFeatureFlags operations = VK_SUBGROUP_FEATURE_VOTE_BIT |
                                                VK_SUBGROUP_FEATURE_BALLOT_BIT |
                                                VK_SUBGROUP_FEATURE_ARITHMETIC_BIT;
  if ((subgroups.supportedOperations & operations) == operations &&
      (subgroups.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0) {
    subgroup_size_ = subgroups.subgroupSize;
  }
  vkGetPhysicalDeviceMemoryProperties(physical, &memory_);
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  timestamp_bits_ = families[family_].timestampValidBits;

  const float priority = 1.0F;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  TRISECT_VK(vkCreateDevice(physical, &info, nullptr, &device_));
  vkGetDeviceQueue(device_, family_, 0, &queue_);
  if (instance.can_name_objects()) {
    set_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
        vkGetDeviceProcAddr(device_, "vkSetDebugUtilsObjectNameEXT"));
  }
}

Device::~Device() {
  vkDestroyDevice(device_, nullptr);
}

uint32_t Device::memory_type(uint32_t allowed, VkMemoryPropertyFlags required,
                             VkMemoryPropertyFlags preferred) const {
  for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
    for (uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
      const bool fits = (memory_.memoryTypes[i].propertyFlags & wanted) == wanted;
      if ((allowed & (1U << i)) != 0 && fits) return i;
    }
  }
  throw Error("device " + report_.name + " has no memory type for a buffer");
}

void Device::name_object(VkObjectType type, uint64_t handle, const std::string& text) const {
  if (set_name_ == nullptr) return;
  VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = text.c_str();
  TRISECT_VK(set_name_(device_, &info));
}

}  // namespace trisect::gpu
