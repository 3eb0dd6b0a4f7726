#include "vk/device.h"

#include <vector>

#include "vk/device_fault.h"
#include "vk/result.h"

namespace trisect::gpu {

namespace {

// A queue family with compute and graphics that can present to the surface, if there is one.
std::optional<uint32_t> presenting_family(VkPhysicalDevice device, VkSurfaceKHR surface) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  constexpr VkQueueFlags both = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT;
  for (uint32_t i = 0; i < count; ++i) {
    VkBool32 presents = VK_FALSE;
    TRISECT_VK(vkGetPhysicalDeviceSurfaceSupportKHR(device, i, surface, &presents));
    if ((families[i].queueFlags & both) == both && presents == VK_TRUE) return i;
  }
  return std::nullopt;
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

Device::Device(const Instance& instance, const std::string& request, VkSurfaceKHR surface,
               std::optional<uint32_t> subgroup_size) {
  const std::vector<DeviceReport> reports = instance.reports();
  const std::size_t index = choose_device(reports, request);
  report_ = reports[index];
  capabilities_ = instance.devices()[index];
  std::optional<uint32_t> family = capabilities_.compute_family;
  std::vector<const char*> surface_extensions;
  if (surface != VK_NULL_HANDLE) {
    const bool has_swapchain = capabilities_.lists(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    family = has_swapchain ? presenting_family(physical(), surface) : std::nullopt;
    if (!family) throw NoDevice("device " + report_.name + " cannot show pictures in this window.");
    surface_extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  }
  family_ = family.value();
  const std::optional<SubgroupChoice> subgroups =
      choose_subgroups(capabilities_.subgroups, subgroup_size);
  if (!subgroups) {
    throw Error("device " + report_.name + " does not let kernels ask for subgroups of " +
                std::to_string(subgroup_size.value()) + " invocations");
  }
  subgroups_ = *subgroups;

  vkGetPhysicalDeviceMemoryProperties(physical(), &memory_);
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical(), &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical(), &count, families.data());
  timestamp_bits_ = families[family_].timestampValidBits;

  create(surface_extensions);
  vkGetDeviceQueue(get(), family_, 0, &queue_);
  const VkPipelineCacheCreateInfo cache_info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  TRISECT_VK(vkCreatePipelineCache(get(), &cache_info, nullptr, pipeline_cache_.fill(get())));
  pipeline_key_ = key_of(capabilities_.properties);
  load_functions(instance.can_name_objects());
}

// With one queue and all that the capabilities have.
void Device::create(std::span<const char* const> surface_extensions) {
  const float priority = 1.0F;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;

  const auto enable_if = [&info](bool has, auto& features) {
    if (!has) return;
    features.pNext = const_cast<void*>(info.pNext);
    info.pNext = &features;
  };
  VkPhysicalDeviceSubgroupSizeControlFeatures subgroups{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES};
  subgroups.subgroupSizeControl = subgroups_.required ? VK_TRUE : VK_FALSE;
  subgroups.computeFullSubgroups = subgroups_.full ? VK_TRUE : VK_FALSE;
  enable_if(subgroups_.required || subgroups_.full, subgroups);
  VkPhysicalDeviceShaderSubgroupUniformControlFlowFeaturesKHR reconvergence{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_FEATURES_KHR};
  reconvergence.shaderSubgroupUniformControlFlow = VK_TRUE;
  enable_if(capabilities_.subgroups.reconverge, reconvergence);
  VkPhysicalDeviceBufferDeviceAddressFeatures addresses{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
  addresses.bufferDeviceAddress = VK_TRUE;
  enable_if(capabilities_.buffer_addresses, addresses);
  VkPhysicalDeviceRayQueryFeaturesKHR queries{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
  queries.rayQuery = VK_TRUE;
  enable_if(capabilities_.ray_queries, queries);
  VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
  structures.accelerationStructure = VK_TRUE;
  enable_if(capabilities_.ray_queries, structures);
  VkPhysicalDeviceFaultFeaturesEXT faults{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FAULT_FEATURES_EXT};
  faults.deviceFault = VK_TRUE;
  enable_if(capabilities_.fault_reports, faults);

  std::vector<const char*> extensions = extensions_for(capabilities_);
  extensions.insert(extensions.end(), surface_extensions.begin(), surface_extensions.end());
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  TRISECT_VK(vkCreateDevice(physical(), &info, nullptr, &handle_.device));
}

void Device::check(VkResult result, const char* call) const {
  if (result == VK_SUCCESS) return;
  const bool can_report = result == VK_ERROR_DEVICE_LOST && get_fault_ != nullptr;
  fail(result, called(call), can_report ? fault_report(get(), get_fault_) : "");
}

void Device::check_wait(VkResult result, const char* call) const {
  if (result != VK_SUCCESS) vkDeviceWaitIdle(get());
  check(result, call);
}

void Device::load_functions(bool can_name_objects) {
  const auto load = [&]<typename Function>(Function& function, const char* name) {
    function = reinterpret_cast<Function>(vkGetDeviceProcAddr(get(), name));
  };
  if (can_name_objects) load(set_name_, "vkSetDebugUtilsObjectNameEXT");
  if (capabilities_.fault_reports) load(get_fault_, "vkGetDeviceFaultInfoEXT");
  if (capabilities_.buffer_addresses) {
    // The extension's function has another name than that of Vulkan 1.2.
    const bool core = capabilities_.version >= VK_API_VERSION_1_2;
    load(address_of_, core ? "vkGetBufferDeviceAddress" : "vkGetBufferDeviceAddressKHR");
  }
  if (!capabilities_.ray_queries) return;
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
