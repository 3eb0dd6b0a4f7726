// Every Vulkan call's result is checked: TRISECT_VK(vkCall(...)) throws an Error that carries the
// call's text.
#pragma once

#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>

namespace trisect::gpu {

// A Vulkan call that did not succeed, or a device that cannot do what is asked of it.
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// No device fits; the message lists each one and what it lacks.
class NoDevice : public Error {
  using Error::Error;
};

// The name of a VkResult, as the specification spells it.
std::string result_name(VkResult result);

void check(VkResult result, const char* call);

#define TRISECT_VK(call) ::trisect::gpu::check((call), #call)

}  // namespace trisect::gpu
