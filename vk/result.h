// Checks of the results of Vulkan calls: TRISECT_VK(vkCall(...)) throws an Error that names the
// call and its result, unless that is VK_SUCCESS.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

#include "vk/error.h"

namespace trisect::gpu {

// The name of a VkResult, as the specification spells it.
std::string result_name(VkResult result);

// The name of the function in the text of a call: what is before the first parenthesis.
std::string called(const char* call);

// Throws the error that a result other than VK_SUCCESS stands for: DeviceLost, OutOfMemory or
// another Error. what: what failed, a call or what it was to make; report: what the driver says of
// it, if anything.
[[noreturn]] void fail(VkResult result, const std::string& what, const std::string& report = "");

// Throws as fail() does, unless the result is VK_SUCCESS. call: its text, for the message.
void check(VkResult result, const char* call);

#define TRISECT_VK(call) ::trisect::gpu::check((call), #call)

}  // namespace trisect::gpu
