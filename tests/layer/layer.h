// The plumbing of a Vulkan layer for tests: what the loader asks of any layer. What a particular
// layer does is in its hooks(); tests/CMakeLists.txt makes a library and a manifest of both.
//
// Specification: "Architecture of the Vulkan Loader Interfaces", Layer Interface, version 2.
#pragma once

#include <vulkan/vulkan.h>

#include <span>

namespace trisect::layer {

// A function that takes the place of a Vulkan function of this name.
struct Hook {
  const char* name;
  PFN_vkVoidFunction function;
  // Whether the program gets the function even if nothing below the layer has it.
  bool always = false;
};

template <typename Function>
Hook make_hook(const char* name, Function function) {
  return {name, reinterpret_cast<PFN_vkVoidFunction>(function)};
}

// `mine` for Vulkan's `function`: it must have the same type.
#define TRISECT_HOOK(function, mine) trisect::layer::make_hook<PFN_##function>(#function, mine)

// What the layer takes part in; all else goes past it. Every layer defines it. Called from several
// threads at once, from the first call of Vulkan on.
std::span<const Hook> hooks();

// What is below the layer, for its hooks to call. handle: the first argument of the call, a
// VkInstance, VkPhysicalDevice, VkDevice, VkQueue or VkCommandBuffer; null for vkCreateInstance. Of
// an instance's functions only those that the layer has a hook for. Returns null if there is no
// such function.
PFN_vkVoidFunction next_function(void* handle, const char* name);

#define TRISECT_NEXT(handle, function) \
  reinterpret_cast<PFN_##function>(trisect::layer::next_function(handle, #function))

// The device that a VkDevice, VkQueue or VkCommandBuffer belongs to; null for other handles.
VkDevice device_of(void* handle);

}  // namespace trisect::layer
