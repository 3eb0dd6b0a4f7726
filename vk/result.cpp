#include "vk/result.h"

#include <cctype>

// vulkan.hpp is used for the names of enumerators only.
#include <vulkan/vulkan.hpp>

namespace trisect::gpu {

std::string result_name(VkResult result) {
  // "ErrorSurfaceLostKHR" is VK_ERROR_SURFACE_LOST_KHR.
  std::string name = "VK";
  bool was_upper = false;
  for (const char c : vk::to_string(static_cast<vk::Result>(result))) {
    const bool is_upper = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (is_upper && !was_upper) name += '_';
    name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    was_upper = is_upper;
  }
  return name;
}

std::string called(const char* call) {
  const std::string text(call);
  return text.substr(0, text.find('('));
}

void fail(VkResult result, const std::string& what, const std::string& report) {
  const std::string where =
      what + " (" + result_name(result) + (report.empty() ? "" : "; " + report) + ")";
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      throw DeviceLost("the Vulkan device was lost at " + where +
                       ": try again, then with a smaller image or another --device.");
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      throw OutOfMemory("the Vulkan device has not enough memory for " + where +
                        ": take a smaller image or model, or another --device.");
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_MEMORY_MAP_FAILED:
      throw OutOfMemory("the machine has not enough memory for " + where +
                        ": close other programs, or take a smaller image or model.");
    default:
      throw Error("the Vulkan driver failed at " + where +
                  ": update it, or take another --device.");
  }
}

void check(VkResult result, const char* call) {
  if (result != VK_SUCCESS) fail(result, called(call));
}

}  // namespace trisect::gpu
