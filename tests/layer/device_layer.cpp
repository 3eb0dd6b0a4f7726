// A layer that makes the device compute as another one may. Environment:
//   TRISECT_TEST_ULPS=1    division, sqrt and inversesqrt are off by up to 2 ulp
//   TRISECT_TEST_FUSED=50  so many in a hundred of the sums with a product are fused
//   TRISECT_TEST_LANES=32  the device reports subgroups of this size, but runs as many lanes as
//   before, and lets no kernel
//                          ask for a size
#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/layer/layer.h"
#include "tests/layer/other_arithmetic.h"

namespace trisect::layer {
namespace {

uint32_t number(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? 0 : static_cast<uint32_t>(std::strtoul(value, nullptr, 10));
}

const OtherArithmetic& arithmetic() {
  static const OtherArithmetic of_environment{
      number("TRISECT_TEST_ULPS") != 0, number("TRISECT_TEST_FUSED"), number("TRISECT_TEST_LANES")};
  return of_environment;
}

VKAPI_ATTR VkResult VKAPI_CALL create_module(VkDevice device, const VkShaderModuleCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkShaderModule* module) {
  const std::vector<uint32_t> code =
      with_other_arithmetic({info->pCode, info->codeSize / sizeof(uint32_t)}, arithmetic());
  VkShaderModuleCreateInfo rewritten = *info;
  rewritten.codeSize = code.size() * sizeof(uint32_t);
  rewritten.pCode = code.data();
  return TRISECT_NEXT(device, vkCreateShaderModule)(device, &rewritten, allocator, module);
}

// The structure of this type in a chain of those that a query fills; null if there is none.
template <typename Structure>
Structure* in_chain(void* chain, VkStructureType type) {
  for (auto* at = static_cast<VkBaseOutStructure*>(chain); at != nullptr; at = at->pNext) {
    if (at->sType == type) return reinterpret_cast<Structure*>(at);
  }
  return nullptr;
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice device,
                                          VkPhysicalDeviceProperties2* properties) {
  TRISECT_NEXT(device, vkGetPhysicalDeviceProperties2)(device, properties);
  if (arithmetic().subgroup_size == 0) return;
  auto* subgroups = in_chain<VkPhysicalDeviceSubgroupProperties>(
      properties->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
  if (subgroups != nullptr) subgroups->subgroupSize = arithmetic().subgroup_size;
}

VKAPI_ATTR void VKAPI_CALL get_features(VkPhysicalDevice device,
                                        VkPhysicalDeviceFeatures2* features) {
  TRISECT_NEXT(device, vkGetPhysicalDeviceFeatures2)(device, features);
  if (arithmetic().subgroup_size == 0) return;
  auto* control = in_chain<VkPhysicalDeviceSubgroupSizeControlFeatures>(
      features->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES);
  if (control != nullptr) control->subgroupSizeControl = control->computeFullSubgroups = VK_FALSE;
}

}  // namespace

std::span<const Hook> hooks() {
  static const std::array all{TRISECT_HOOK(vkCreateShaderModule, create_module),
                              TRISECT_HOOK(vkGetPhysicalDeviceProperties2, get_properties),
                              TRISECT_HOOK(vkGetPhysicalDeviceFeatures2, get_features)};
  return all;
}

}  // namespace trisect::layer
