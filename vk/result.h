// Every Vulkan call's result is checked: TRISECT_VK(vkCall(...)) throws an Error that carries the
// call's text.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

#include "vk/error.h"

namespace trisect::gpu {

// The name of a VkResult, as the specification spells it.
std::string result_name(VkResult result);

void check(VkResult result, const char* call);

#define TRISECT_VK(call) ::trisect::gpu::check((call), #call)

}  // namespace trisect::gpu
