#include "vk/device.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "vk/result.h"

namespace trisect::gpu {

namespace {

const char* const kAddressExtension = VK_KHR_BUFFER_DEVICE_ADDRESS_EXTENSION_NAME;

bool has_extension(VkPhysicalDevice device, std::string_view name) {
  uint32_t count = 0;
  TRISECT_VK(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr));
  std::vector<VkExtensionProperties> extensions(count);
  TRISECT_VK(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()));
  return std::any_of(
      extensions.begin(), extensions.end(),
      [name](const VkExtensionProperties& extension) { return extension.extensionName == name; });
}

bool can_address_buffers(VkPhysicalDevice device) {
  if (!has_extension(device, kAddressExtension)) return false;
  VkPhysicalDeviceBufferDeviceAddressFeaturesKHR addresses{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES_KHR};
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  features.pNext = &addresses;
  vkGetPhysicalDeviceFeatures2(device, &features);
  return addresses.bufferDeviceAddress == VK_TRUE;
}

// The extensions that ray queries need in Vulkan 1.1, beside that for buffer addresses.
constexpr std::array kQueryExtensions{VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                      VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                      VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
                                      VK_EXT_DESCRIPTOR_INDEXING_EXTENSION_NAME,
                                      VK_KHR_SPIRV_1_4_EXTENSION_NAME,
                                      VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME};

bool can_query_rays(VkPhysicalDevice device) {
  const bool has_all =
      std::all_of(kQueryExtensions.begin(), kQueryExtensions.end(),
                  [device](const char* name) { return has_extension(device, name); });
  if (!has_all || !can_address_buffers(device)) return false;
  VkPhysicalDeviceRayQueryFeaturesKHR queries{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
  structures.pNext = &queries;
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  features.pNext = &structures;
  vkGetPhysicalDeviceFeatures2(device, &features);
  return queries.rayQuery == VK_TRUE && structures.accelerationStructure == VK_TRUE;
}

VkDeviceSize scratch_alignment_of(VkPhysicalDevice device) {
  VkPhysicalDeviceAccelerationStructurePropertiesKHR structures{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  properties.pNext = &structures;
  vkGetPhysicalDeviceProperties2(device, &properties);
  return structures.minAccelerationStructureScratchOffsetAlignment;
}

// The index of a queue family with compute and graphics that can present to the surface, or -1.
int presenting_family(VkPhysicalDevice device, VkSurfaceKHR surface) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  constexpr VkQueueFlags both = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT;
  for (uint32_t i = 0; i < count; ++i) {
    VkBool32 presents = VK_FALSE;
    TRISECT_VK(vkGetPhysicalDeviceSurfaceSupportKHR(device, i, surface, &presents));
    if ((families[i].queueFlags & both) == both && presents == VK_TRUE) return static_cast<int>(i);
  }
  return -1;
}

// Device::pipeline_key(): the identifiers in the header of a pipeline cache, and the driver's
// version.
std::string key_of(const VkPhysicalDeviceProperties& properties) {
  constexpr const char* digits = "0123456789abcdef";
  std::string key;
  const auto add = [&](uint32_t value, int count) {
    for (int digit = count - 1; digit >= 0; --digit) {
      key += digits[(value >> (4U * static_cast<uint32_t>(digit))) & 15U];
    }
  };
  for (const uint32_t value :
       {properties.vendorID, properties.deviceID, properties.driverVersion}) {
    add(value, 8);
    key += '-';
  }
  for (const uint8_t byte : properties.pipelineCacheUUID) add(byte, 2);
  return key;
}

}  // namespace

Device::Device(const Instance& instance, const std::string& request, VkSurfaceKHR surface) {
  const std::vector<DeviceReport> reports = instance.reports();
  const std::size_t index = choose_device(reports, request);
  const VkPhysicalDevice physical = instance.physical_devices()[index];
  report_ = reports[index];
  physical_ = physical;
  int family = compute_family(physical);
  std::vector<const char*> extensions;
  if (surface != VK_NULL_HANDLE) {
    const bool has_swapchain = has_extension(physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    family = has_swapchain ? presenting_family(physical, surface) : -1;
    if (family < 0) {
      throw NoDevice("device " + report_.name + " cannot show pictures in this window.");
    }
    extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  }
  family_ = static_cast<uint32_t>(family);

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
    extensions.push_back(kAddressExtension);
  }
  const bool queries = can_query_rays(physical);
  VkPhysicalDeviceRayQueryFeaturesKHR query_features{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
  query_features.rayQuery = VK_TRUE;
  query_features.pNext = &address_features;
  VkPhysicalDeviceAccelerationStructureFeaturesKHR structure_features{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
  structure_features.accelerationStructure = VK_TRUE;
  structure_features.pNext = &query_features;
  if (queries) {
    info.pNext = &structure_features;
    for (const char* name : kQueryExtensions) extensions.push_back(name);
    scratch_alignment_ = scratch_alignment_of(physical);
  }
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  TRISECT_VK(vkCreateDevice(physical, &info, nullptr, &handle_.device));
  vkGetDeviceQueue(get(), family_, 0, &queue_);
  const VkPipelineCacheCreateInfo cache_info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  TRISECT_VK(vkCreatePipelineCache(get(), &cache_info, nullptr, pipeline_cache_.fill(get())));
  pipeline_key_ = key_of(properties.properties);
  if (instance.can_name_objects()) {
    set_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
        vkGetDeviceProcAddr(get(), "vkSetDebugUtilsObjectNameEXT"));
  }
  if (addresses) {
    address_of_ = reinterpret_cast<PFN_vkGetBufferDeviceAddressKHR>(
        vkGetDeviceProcAddr(get(), "vkGetBufferDeviceAddressKHR"));
  }
  if (queries) load_structure_functions();
}

void Device::load_structure_functions() {
  const auto load = [&]<typename Function>(Function& function, const char* name) {
    function = reinterpret_cast<Function>(vkGetDeviceProcAddr(get(), name));
  };
  load(structures_.create, "vkCreateAccelerationStructureKHR");
  load(structures_.destroy, "vkDestroyAccelerationStructureKHR");
  load(structures_.get_sizes, "vkGetAccelerationStructureBuildSizesKHR");
  load(structures_.get_address, "vkGetAccelerationStructureDeviceAddressKHR");
  load(structures_.build, "vkCmdBuildAccelerationStructuresKHR");
}

VkDeviceAddress Device::address_of(VkBuffer buffer) const {
  VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
  info.buffer = buffer;
  return address_of_(get(), &info);
}

std::vector<std::byte> Device::pipeline_data() const {
  std::size_t size = 0;
  TRISECT_VK(vkGetPipelineCacheData(get(), pipeline_cache(), &size, nullptr));
  std::vector<std::byte> data(size);
  TRISECT_VK(vkGetPipelineCacheData(get(), pipeline_cache(), &size, data.data()));
  data.resize(size);
  return data;
}

void Device::add_pipeline_data(std::span<const std::byte> data) const {
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  info.initialDataSize = data.size();
  info.pInitialData = data.data();
  Owned<VkPipelineCache, vkDestroyPipelineCache> added;
  TRISECT_VK(vkCreatePipelineCache(get(), &info, nullptr, added.fill(get())));
  const VkPipelineCache from = added.get();
  TRISECT_VK(vkMergePipelineCaches(get(), pipeline_cache(), 1, &from));
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
  TRISECT_VK(set_name_(get(), &info));
}

}  // namespace trisect::gpu
