// A layer that lets calls of Vulkan fail. Environment:
//   TRISECT_TEST_FAIL=vkAllocateMemory:3:VK_ERROR_OUT_OF_DEVICE_MEMORY
//     The third call of this function fails with this result; `*` for the function counts all calls
//     that can fail. What is below the layer hears nothing of the call. After VK_ERROR_DEVICE_LOST
//     the device is lost: its queue does nothing any more, and all that waits for it fails too.
//   TRISECT_TEST_CALLS=FILE
//     Writes a line with the name of the function for each call that can fail.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "tests/layer/layer.h"

namespace trisect::layer {
namespace {

constexpr std::array<std::pair<std::string_view, VkResult>, 6> kResults{{
    {"VK_ERROR_OUT_OF_HOST_MEMORY", VK_ERROR_OUT_OF_HOST_MEMORY},
    {"VK_ERROR_OUT_OF_DEVICE_MEMORY", VK_ERROR_OUT_OF_DEVICE_MEMORY},
    {"VK_ERROR_INITIALIZATION_FAILED", VK_ERROR_INITIALIZATION_FAILED},
    {"VK_ERROR_DEVICE_LOST", VK_ERROR_DEVICE_LOST},
    {"VK_ERROR_SURFACE_LOST_KHR", VK_ERROR_SURFACE_LOST_KHR},
    {"VK_ERROR_UNKNOWN", VK_ERROR_UNKNOWN},
}};

// A fault of the test is no fault of the program: it must not look like one.
[[noreturn]] void give_up(const std::string& reason) {
  std::fprintf(stderr, "VK_LAYER_TRISECT_fault: %s\n", reason.c_str());
  std::abort();
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Which calls fail. For several threads at once.
class Faults {
 public:
  Faults() {
    const std::string calls = variable("TRISECT_TEST_CALLS");
    if (!calls.empty()) calls_.open(calls, std::ios::app);
    const std::string text = variable("TRISECT_TEST_FAIL");
    if (text.empty()) return;
    std::istringstream words(text);
    std::string result;
    std::getline(words, function_, ':');
    words >> left_;
    words.ignore(1, ':');
    words >> result;
    for (const auto& [name, value] : kResults) {
      if (name == result) result_ = value;
    }
    if (left_ < 1 || result_ == VK_SUCCESS) give_up("TRISECT_TEST_FAIL cannot be " + text);
  }

  // What the present call of this function fails with; nothing if it does not.
  std::optional<VkResult> next_call(std::string_view function) {
    const std::lock_guard lock(mutex_);
    if (calls_.is_open()) calls_ << function << std::endl;
    if (left_ == 0 || (function_ != "*" && function_ != function)) return {};
    --left_;
    if (left_ > 0) return {};
    return result_;
  }

 private:
  std::mutex mutex_;
  std::ofstream calls_;
  std::string function_;
  int64_t left_ = 0;  // calls until the one that fails; 0 if none does any more
  VkResult result_ = VK_SUCCESS;
};

Faults& faults() {
  static Faults all;
  return all;
}

// The lost device. One is enough: a program that loses it ends.
std::mutex lost_mutex;
VkDevice lost_device = VK_NULL_HANDLE;

bool is_lost(VkDevice device) {
  const std::lock_guard lock(lost_mutex);
  return device != VK_NULL_HANDLE && device == lost_device;
}

// What the device executes comes to its end, as a lost device does nothing any more.
void lose(VkDevice device) {
  TRISECT_NEXT(device, vkDeviceWaitIdle)(device);
  const std::lock_guard lock(lost_mutex);
  lost_device = device;
}

// As vulkan_xcb.h and vulkan_xlib.h have them, but for the types of the windows.
using PFN_vkCreateXcbSurfaceKHR = VkResult(VKAPI_PTR*)(VkInstance, const void*,
                                                       const VkAllocationCallbacks*, VkSurfaceKHR*);
using PFN_vkCreateXlibSurfaceKHR = PFN_vkCreateXcbSurfaceKHR;

// The functions that can fail, of all that the program and its libraries call. After a loss those
// in the second list fail always: the specification lets them (chapter "Lost Device").
#define TRISECT_FAILING(X)                     \
  X(vkCreateInstance)                          \
  X(vkEnumeratePhysicalDevices)                \
  X(vkEnumerateDeviceExtensionProperties)      \
  X(vkCreateDebugUtilsMessengerEXT)            \
  X(vkSetDebugUtilsObjectNameEXT)              \
  X(vkCreateXcbSurfaceKHR)                     \
  X(vkCreateXlibSurfaceKHR)                    \
  X(vkGetPhysicalDeviceSurfaceSupportKHR)      \
  X(vkGetPhysicalDeviceSurfaceCapabilitiesKHR) \
  X(vkGetPhysicalDeviceSurfaceFormatsKHR)      \
  X(vkGetPhysicalDeviceSurfacePresentModesKHR) \
  X(vkCreateDevice)                            \
  X(vkCreatePipelineCache)                     \
  X(vkGetPipelineCacheData)                    \
  X(vkMergePipelineCaches)                     \
  X(vkCreateBuffer)                            \
  X(vkCreateImage)                             \
  X(vkCreateImageView)                         \
  X(vkCreateSampler)                           \
  X(vkAllocateMemory)                          \
  X(vkBindBufferMemory)                        \
  X(vkBindImageMemory)                         \
  X(vkMapMemory)                               \
  X(vkFlushMappedMemoryRanges)                 \
  X(vkCreateShaderModule)                      \
  X(vkCreateDescriptorSetLayout)               \
  X(vkCreatePipelineLayout)                    \
  X(vkCreateDescriptorPool)                    \
  X(vkAllocateDescriptorSets)                  \
  X(vkCreateRenderPass)                        \
  X(vkCreateFramebuffer)                       \
  X(vkCreateComputePipelines)                  \
  X(vkCreateGraphicsPipelines)                 \
  X(vkCreateAccelerationStructureKHR)          \
  X(vkCreateQueryPool)                         \
  X(vkCreateFence)                             \
  X(vkCreateSemaphore)                         \
  X(vkResetFences)                             \
  X(vkCreateCommandPool)                       \
  X(vkAllocateCommandBuffers)                  \
  X(vkResetCommandPool)                        \
  X(vkBeginCommandBuffer)                      \
  X(vkEndCommandBuffer)                        \
  X(vkCreateSwapchainKHR)                      \
  X(vkGetSwapchainImagesKHR)
#define TRISECT_LOSING(X)  \
  X(vkQueueSubmit)         \
  X(vkWaitForFences)       \
  X(vkQueueWaitIdle)       \
  X(vkDeviceWaitIdle)      \
  X(vkGetQueryPoolResults) \
  X(vkAcquireNextImageKHR) \
  X(vkQueuePresentKHR)

#define TRISECT_TAG(function)                      \
  struct Tag_##function {                          \
    static constexpr const char* name = #function; \
    using Function = PFN_##function;               \
  };
TRISECT_FAILING(TRISECT_TAG)
TRISECT_LOSING(TRISECT_TAG)

// The hook of one function. losing: whether it fails on a lost device.
template <typename Tag, bool losing, typename Function = typename Tag::Function>
struct Failing;

template <typename Tag, bool losing, typename First, typename... Rest>
struct Failing<Tag, losing, VkResult(VKAPI_PTR*)(First, Rest...)> {
  static VKAPI_ATTR VkResult VKAPI_CALL call(First first, Rest... rest) {
    void* handle = nullptr;
    VkDevice device = VK_NULL_HANDLE;
    if constexpr (!std::is_same_v<First, const VkInstanceCreateInfo*>) {
      handle = first;
      device = device_of(handle);
    }
    const std::optional<VkResult> failure = faults().next_call(Tag::name);
    if (failure == VK_ERROR_DEVICE_LOST && device != VK_NULL_HANDLE) lose(device);
    if (failure) return *failure;
    if (losing && is_lost(device)) return VK_ERROR_DEVICE_LOST;
    const auto next = reinterpret_cast<typename Tag::Function>(next_function(handle, Tag::name));
    return next(first, rest...);
  }
};

#define TRISECT_FAILING_HOOK(function) \
  TRISECT_HOOK(function, (Failing<Tag_##function, false>::call)),
#define TRISECT_LOSING_HOOK(function) TRISECT_HOOK(function, (Failing<Tag_##function, true>::call)),

}  // namespace

std::span<const Hook> hooks() {
  static const std::array all{TRISECT_FAILING(TRISECT_FAILING_HOOK)
                                  TRISECT_LOSING(TRISECT_LOSING_HOOK)};
  return all;
}

}  // namespace trisect::layer
