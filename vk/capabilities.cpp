#include "vk/capabilities.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>

#include "vk/result.h"

namespace trisect::gpu {
namespace {

// The extension's header is among the beta ones.
const char* const kPortabilitySubset = "VK_KHR_portability_subset";

// An extension, and the Vulkan version that has what it brings.
struct Extension {
  const char* name;
  uint32_t core;
};

constexpr Extension kAddresses{VK_KHR_BUFFER_DEVICE_ADDRESS_EXTENSION_NAME, VK_API_VERSION_1_2};
constexpr Extension kFloatControls{VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME, VK_API_VERSION_1_2};
constexpr Extension kDriverProperties{VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME, VK_API_VERSION_1_2};
constexpr Extension kSubgroupSize{VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME, VK_API_VERSION_1_3};
constexpr Extension kReconvergence{VK_KHR_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_EXTENSION_NAME,
                                   kNeverCore};
constexpr Extension kDeviceFault{VK_EXT_DEVICE_FAULT_EXTENSION_NAME, kNeverCore};

// What ray queries need beside buffer addresses.
constexpr std::array kQueries{
    Extension{VK_KHR_RAY_QUERY_EXTENSION_NAME, kNeverCore},
    Extension{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, kNeverCore},
    Extension{VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME, kNeverCore},
    Extension{VK_EXT_DESCRIPTOR_INDEXING_EXTENSION_NAME, VK_API_VERSION_1_2},
    Extension{VK_KHR_SPIRV_1_4_EXTENSION_NAME, VK_API_VERSION_1_2},
    Extension{VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME, VK_API_VERSION_1_2}};

bool offers(const Capabilities& of, const Extension& extension) {
  return of.offers(extension.name, extension.core);
}

std::vector<std::string> extensions_of(VkPhysicalDevice device) {
  uint32_t count = 0;
  TRISECT_VK(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr));
  std::vector<VkExtensionProperties> extensions(count);
  TRISECT_VK(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()));
  std::vector<std::string> names;
  names.reserve(extensions.size());
  for (const VkExtensionProperties& extension : extensions) {
    names.emplace_back(extension.extensionName);
  }
  return names;
}

std::optional<uint32_t> compute_family(VkPhysicalDevice device) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  for (uint32_t i = 0; i < count; ++i) {
    if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0) return i;
  }
  return std::nullopt;
}

// The chain of structures that a query fills.
template <typename Head>
class Chain {
 public:
  explicit Chain(Head& head) : head_(head) {}

  template <typename Structure>
  void add_if(bool is_known, Structure& structure) {
    if (!is_known) return;
    structure.pNext = head_.pNext;
    head_.pNext = &structure;
  }

 private:
  Head& head_;
};

SubgroupSupport subgroups_of(const VkPhysicalDeviceSubgroupProperties& subgroups,
                             const VkPhysicalDeviceSubgroupSizeControlFeatures& control,
                             const VkPhysicalDeviceSubgroupSizeControlProperties& sizes) {
  constexpr VkSubgroupFeatureFlags operations = VK_SUBGROUP_FEATURE_VOTE_BIT |
                                                VK_SUBGROUP_FEATURE_BALLOT_BIT |
                                                VK_SUBGROUP_FEATURE_ARITHMETIC_BIT;
  SubgroupSupport support;
  if ((subgroups.supportedOperations & operations) != operations ||
      (subgroups.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) == 0) {
    return support;
  }
  support.size = subgroups.subgroupSize;
  support.full = control.computeFullSubgroups == VK_TRUE;
  if (control.subgroupSizeControl != VK_TRUE ||
      (sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) == 0) {
    return support;
  }
  // A workgroup must not fall into more subgroups than the device allows, and the size must divide
  // it for the subgroups to be full.
  uint32_t least = sizes.minSubgroupSize;
  while (least * sizes.maxComputeWorkgroupSubgroups < KernelNeeds::kInvocations) least *= 2;
  const uint32_t most = std::min(sizes.maxSubgroupSize, KernelNeeds::kInvocations);
  if (least <= most) {
    support.least = least;
    support.most = most;
  }
  return support;
}

// The first number of what a Mesa driver tells of itself, "Mesa 25.0.7 (LLVM 15.0.6)"; 0 if there
// is none. lavapipe's driverVersion is 1 in all of them.
int mesa_version(std::string_view info) {
  constexpr std::string_view name = "Mesa ";
  int version = 0;
  if (info.starts_with(name)) {
    info.remove_prefix(name.size());
    std::from_chars(info.data(), info.data() + info.size(), version);
  }
  return version;
}

}  // namespace

std::vector<std::string> unmet_needs(const VkPhysicalDeviceLimits& limits) {
  struct Need {
    uint32_t least;
    const char* what;
    const char* limit;
    uint32_t has;
  };
  using Needs = KernelNeeds;
  constexpr uint32_t resources = Needs::kStorageBuffers + Needs::kUniformBuffers;
  const Need needs[] = {
      {Needs::kInvocations, "invocations in a workgroup", "maxComputeWorkGroupInvocations",
       limits.maxComputeWorkGroupInvocations},
      {Needs::kInvocations, "invocations along a workgroup's x", "maxComputeWorkGroupSize[0]",
       limits.maxComputeWorkGroupSize[0]},
      {Needs::kInvocationsY, "invocations along a workgroup's y", "maxComputeWorkGroupSize[1]",
       limits.maxComputeWorkGroupSize[1]},
      {Needs::kSharedBytes, "bytes of shared memory", "maxComputeSharedMemorySize",
       limits.maxComputeSharedMemorySize},
      {1, "descriptor set", "maxBoundDescriptorSets", limits.maxBoundDescriptorSets},
      {Needs::kStorageBuffers, "storage buffers in a stage", "maxPerStageDescriptorStorageBuffers",
       limits.maxPerStageDescriptorStorageBuffers},
      {Needs::kStorageBuffers, "storage buffers in a set", "maxDescriptorSetStorageBuffers",
       limits.maxDescriptorSetStorageBuffers},
      {Needs::kUniformBuffers, "uniform buffers in a stage", "maxPerStageDescriptorUniformBuffers",
       limits.maxPerStageDescriptorUniformBuffers},
      {Needs::kUniformBuffers, "uniform buffers in a set", "maxDescriptorSetUniformBuffers",
       limits.maxDescriptorSetUniformBuffers},
      {resources, "buffers in a stage", "maxPerStageResources", limits.maxPerStageResources},
      {Needs::kPushBytes, "bytes of push constants", "maxPushConstantsSize",
       limits.maxPushConstantsSize},
      {Needs::kStorageRange, "bytes in a storage buffer", "maxStorageBufferRange",
       limits.maxStorageBufferRange},
  };
  std::vector<std::string> unmet;
  for (const Need& need : needs) {
    if (need.has >= need.least) continue;
    unmet.push_back(std::to_string(need.least) + " " + need.what + " (" + need.limit + " is " +
                    std::to_string(need.has) + ")");
  }
  return unmet;
}

std::vector<uint32_t> SubgroupSupport::sizes() const {
  std::vector<uint32_t> all;
  for (uint32_t candidate = least; candidate != 0 && candidate <= most; candidate *= 2) {
    all.push_back(candidate);
  }
  return all;
}

std::optional<SubgroupChoice> choose_subgroups(const SubgroupSupport& support,
                                               std::optional<uint32_t> asked) {
  if (support.size == 0 || asked == 0U) {
    return asked.value_or(0) == 0 ? std::optional(SubgroupChoice{}) : std::nullopt;
  }
  const std::vector<uint32_t> sizes = support.sizes();
  if (asked) {
    const bool allowed = std::find(sizes.begin(), sizes.end(), *asked) != sizes.end();
    if (!allowed) return std::nullopt;
    return SubgroupChoice{*asked, true, support.full};
  }
  if (sizes.empty()) return SubgroupChoice{support.size, false, support.full};
  // Sixteen, or what is next to it. The kernels hold much per ray: of 8, 16 and 32 lanes, all of
  // which Intel has, 32 leave a lane too few registers and spill; 8 are the fewest that a packet
  // can do with and share its descent among few rays. Of AMD's 32 and 64, 32 lose fewer lanes to
  // rays that end early. NVIDIA and Apple have 32 only, lavapipe 8, SwiftShader 4. This is reasoned
  // and not measured.
  constexpr uint32_t preferred = 16;
  return SubgroupChoice{std::clamp(preferred, support.least, support.most), true, support.full};
}

bool Capabilities::lists(std::string_view extension) const {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

Capabilities capabilities_of(VkPhysicalDevice device, uint32_t instance_version) {
  Capabilities found;
  found.device = device;
  vkGetPhysicalDeviceProperties(device, &found.properties);
  found.version = std::min(found.properties.apiVersion, instance_version);
  found.driver = std::to_string(found.properties.driverVersion);
  found.compute_family = compute_family(device);
  found.extensions = extensions_of(device);
  // The queries that follow came with Vulkan 1.1.
  if (found.version < VK_API_VERSION_1_1) return found;

  const bool has_queries =
      std::all_of(kQueries.begin(), kQueries.end(),
                  [&](const Extension& extension) { return offers(found, extension); });
  VkPhysicalDeviceSubgroupSizeControlFeatures subgroup_control{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES};
  VkPhysicalDeviceShaderSubgroupUniformControlFlowFeaturesKHR reconvergence{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_FEATURES_KHR};
  VkPhysicalDeviceBufferDeviceAddressFeatures addresses{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
  VkPhysicalDeviceFaultFeaturesEXT faults{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FAULT_FEATURES_EXT};
  VkPhysicalDeviceRayQueryFeaturesKHR queries{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  Chain asked(features);
  asked.add_if(offers(found, kSubgroupSize), subgroup_control);
  asked.add_if(offers(found, kReconvergence), reconvergence);
  asked.add_if(offers(found, kAddresses), addresses);
  asked.add_if(offers(found, kDeviceFault), faults);
  asked.add_if(has_queries, queries);
  asked.add_if(has_queries, structures);
  vkGetPhysicalDeviceFeatures2(device, &features);

  VkPhysicalDeviceSubgroupProperties subgroups{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
  VkPhysicalDeviceSubgroupSizeControlProperties subgroup_sizes{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES};
  VkPhysicalDeviceFloatControlsProperties floats{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES};
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceAccelerationStructurePropertiesKHR structure_properties{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  Chain told(properties);
  told.add_if(true, subgroups);
  told.add_if(offers(found, kSubgroupSize), subgroup_sizes);
  told.add_if(offers(found, kFloatControls), floats);
  told.add_if(offers(found, kDriverProperties), driver);
  told.add_if(has_queries, structure_properties);
  vkGetPhysicalDeviceProperties2(device, &properties);

  if (offers(found, kDriverProperties)) {
    found.driver = driver.driverName;
    // SwiftShader's is empty.
    if (driver.driverInfo[0] != '\0') found.driver += std::string(", ") + driver.driverInfo;
    found.wants_specialized_code = driver.driverID == VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
    found.loads_fast_by_address =
        driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE && mesa_version(driver.driverInfo) >= 25;
  }
  found.subgroups = subgroups_of(subgroups, subgroup_control, subgroup_sizes);
  found.subgroups.reconverge = reconvergence.shaderSubgroupUniformControlFlow == VK_TRUE;
  // Without independence a module must declare the modes of all widths alike.
  constexpr auto none = VK_SHADER_FLOAT_CONTROLS_INDEPENDENCE_NONE;
  found.floats = {
      floats.shaderRoundingModeRTEFloat32 == VK_TRUE && floats.roundingModeIndependence != none,
      floats.shaderSignedZeroInfNanPreserveFloat32 == VK_TRUE,
      floats.shaderDenormPreserveFloat32 == VK_TRUE && floats.denormBehaviorIndependence != none};
  found.buffer_addresses = addresses.bufferDeviceAddress == VK_TRUE;
  found.fault_reports = faults.deviceFault == VK_TRUE;
  found.ray_queries = found.buffer_addresses && queries.rayQuery == VK_TRUE &&
                      structures.accelerationStructure == VK_TRUE;
  if (found.ray_queries) {
    found.scratch_alignment = structure_properties.minAccelerationStructureScratchOffsetAlignment;
  }
  return found;
}

std::vector<const char*> extensions_for(const Capabilities& capabilities) {
  std::vector<const char*> names;
  const auto add = [&](const Extension& extension) {
    if (capabilities.version >= extension.core || !capabilities.lists(extension.name)) return;
    const auto is_it = [&](std::string_view name) { return name == extension.name; };
    if (std::none_of(names.begin(), names.end(), is_it)) names.push_back(extension.name);
  };
  if (capabilities.buffer_addresses) add(kAddresses);
  if (capabilities.subgroups.reconverge) add(kReconvergence);
  if (capabilities.fault_reports) add(kDeviceFault);
  if (capabilities.subgroups.least != 0 || capabilities.subgroups.full) add(kSubgroupSize);
  add(kFloatControls);
  if (capabilities.ray_queries) {
    for (const Extension& extension : kQueries) add(extension);
  }
  // A device that lists it lacks some of what Vulkan promises, and must be made with it (MoltenVK).
  // What it may lack are features of pictures and of vertex input: triangle fans, views of images
  // that exchange their channels, events, offsets of vertex attributes past their stride. Neither
  // the kernels nor the window use any of them.
  add({kPortabilitySubset, kNeverCore});
  return names;
}

}  // namespace trisect::gpu
