#include "vk/device.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "vk/result.h"

namespace trisect::gpu {

namespace {

const char* const kAddressExtension = VK_KHR_BUFFER_DEVICE_ADDRESS_EXTENSION_NAME;

bool can_address_buffers(VkPhysicalDevice device) {
  uint32_t count = 0;
  TRISECT_VK(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr));
  std::vector<VkExtensionProperties> extensions(count);
  TRISECT_VK(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()));
  const bool known =
      std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& extension) {
        return std::string_view(extension.extensionName) == kAddressExtension;
      });
  if (!known) return false;
  VkPhysicalDeviceBufferDeviceAddressFeaturesKHR addresses{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES_KHR};
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  features.pNext = &addresses;
  vkGetPhysicalDeviceFeatures2(device, &features);
  return addresses.bufferDeviceAddress == VK_TRUE;
}

}  // namespace

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
  const bool addresses = can_address_buffers(physical);
  VkPhysicalDeviceBufferDeviceAddressFeaturesKHR address_features{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES_KHR};
  address_features.bufferDeviceAddress = VK_TRUE;
  if (addresses) {
    info.pNext = &address_features;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &kAddressExtension;
  }
  TRISECT_VK(vkCreateDevice(physical, &info, nullptr, &device_));
  vkGetDeviceQueue(device_, family_, 0, &queue_);
  if (instance.can_name_objects()) {
    set_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
        vkGetDeviceProcAddr(device_, "vkSetDebugUtilsObjectNameEXT"));
  }
  if (addresses) {
    address_of_ = reinterpret_cast<PFN_vkGetBufferDeviceAddressKHR>(
        vkGetDeviceProcAddr(device_, "vkGetBufferDeviceAddressKHR"));
  }
}

Device::~Device() {
  vkDestroyDevice(device_, nullptr);
}

VkDeviceAddress Device::address_of(VkBuffer buffer) const {
  VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
  info.buffer = buffer;
  return address_of_(device_, &info);
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
