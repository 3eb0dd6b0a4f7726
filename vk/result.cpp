#include "vk/result.h"

// vulkan.hpp is used for the names of enumerators only.
#include <vulkan/vulkan.hpp>

namespace trisect::gpu {

std::string result_name(VkResult result) {
  return vk::to_string(static_cast<vk::Result>(result));
}

void check(VkResult result, const char* call) {
  if (result == VK_SUCCESS) return;
  const std::string text(call);
  throw Error(text.substr(0, text.find('(')) + " failed: " + result_name(result));
}

}  // namespace trisect::gpu
