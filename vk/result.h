// Checks of the results of Vulkan calls: TRISECT_VK(vkCall(...)) throws an Error that names the
// call and its result, unless that is VK_SUCCESS.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

#include "vk/error.h"

namespace trisect::gpu {

// The name of a VkResult, as the specification spells it.
std::string result_name(VkResult result);

// call: its text; what is before the first parenthesis goes into the message.
void check(VkResult result, const char* call);

#define TRISECT_VK(call) ::trisect::gpu::check((call), #call)

}  // namespace trisect::gpu
