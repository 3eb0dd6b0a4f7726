// A layer that lets calls of Vulkan fail. Environment:
//   TRISECT_TEST_FAIL=vkAllocateMemory:3:VK_ERROR_OUT_OF_DEVICE_MEMORY
//     The third call of this function fails with this result; `*` for the function counts all calls
//     that can fail. What is below the layer hears nothing of the call. After VK_ERROR_DEVICE_LOST
//     the device is lost: its queue does nothing any more, and all that waits for it fails too.
//     With HANG for the result the call never returns.
//   TRISECT_TEST_CALLS=FILE
//     Writes a line with the name of the function for each call that can fail.
//   TRISECT_TEST_FAULT_REPORT=1
//     The devices have VK_EXT_device_fault, with a report of one address and one vendor's code.
//   TRISECT_TEST_EMPTY_KERNELS=1
//     Kernels do nothing, and so need next to no time to be compiled: of a run nothing but the
//     calls is left. Short ones stay, by which a frame goes on from pass to pass. All timestamps
//     are 0, so that the number of calls does not depend on how long they take.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

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
    hangs_ = result == "HANG";
    for (const auto& [name, value] : kResults) {
      if (name == result) result_ = value;
    }
    const bool is_known = hangs_ || result_ != VK_SUCCESS;
    if (left_ < 1 || !is_known) give_up("TRISECT_TEST_FAIL cannot be " + text);
  }

  // What the present call of this function fails with; nothing if it does not.
  std::optional<VkResult> next_call(std::string_view function) {
    const std::lock_guard lock(mutex_);
    if (calls_.is_open()) calls_ << function << std::endl;
    if (left_ == 0 || (function_ != "*" && function_ != function)) return {};
    --left_;
    if (left_ > 0) return {};
    while (hangs_) pause();
    return result_;
  }

 private:
  std::mutex mutex_;
  std::ofstream calls_;
  std::string function_;
  int64_t left_ = 0;  // calls until the one that fails; 0 if none does any more
  VkResult result_ = VK_SUCCESS;
  bool hangs_ = false;
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

// The fake VK_EXT_device_fault. What is below the layer need not know the extension, so it does not
// hear of it.
namespace fault_report {

bool is_faked() {
  static const bool faked = !variable("TRISECT_TEST_FAULT_REPORT").empty();
  return faked;
}

VKAPI_ATTR VkResult VKAPI_CALL enumerate_extensions(VkPhysicalDevice device, const char* layer,
                                                    uint32_t* count,
                                                    VkExtensionProperties* extensions) {
  const auto next = TRISECT_NEXT(device, vkEnumerateDeviceExtensionProperties);
  uint32_t below = 0;
  if (const VkResult result = next(device, layer, &below, nullptr); result != VK_SUCCESS) {
    return result;
  }
  std::vector<VkExtensionProperties> all(below);
  if (const VkResult result = next(device, layer, &below, all.data()); result != VK_SUCCESS) {
    return result;
  }
  VkExtensionProperties& fault = all.emplace_back();
  std::snprintf(fault.extensionName, sizeof(fault.extensionName), "%s",
                VK_EXT_DEVICE_FAULT_EXTENSION_NAME);
  fault.specVersion = VK_EXT_DEVICE_FAULT_SPEC_VERSION;
  const auto size = static_cast<uint32_t>(all.size());
  if (extensions == nullptr) {
    *count = size;
    return VK_SUCCESS;
  }
  *count = std::min(*count, size);
  std::copy_n(all.begin(), *count, extensions);
  return *count < size ? VK_INCOMPLETE : VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL get_features(VkPhysicalDevice device,
                                        VkPhysicalDeviceFeatures2* features) {
  TRISECT_NEXT(device, vkGetPhysicalDeviceFeatures2)(device, features);
  for (auto* at = static_cast<VkBaseOutStructure*>(features->pNext); at != nullptr;
       at = at->pNext) {
    if (at->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FAULT_FEATURES_EXT) continue;
    reinterpret_cast<VkPhysicalDeviceFaultFeaturesEXT*>(at)->deviceFault = VK_TRUE;
  }
}

// Makes the device without the extension and its structure.
VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkDevice* device) {
  VkDeviceCreateInfo without = *info;
  std::vector<const char*> names;
  for (uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
    const char* name = info->ppEnabledExtensionNames[i];
    if (std::string_view(name) != VK_EXT_DEVICE_FAULT_EXTENSION_NAME) names.push_back(name);
  }
  without.enabledExtensionCount = static_cast<uint32_t>(names.size());
  without.ppEnabledExtensionNames = names.data();
  // The structure is taken out of the program's own chain for the time of the call.
  auto* before = reinterpret_cast<VkBaseInStructure*>(&without);
  while (before->pNext != nullptr &&
         before->pNext->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FAULT_FEATURES_EXT) {
    before = const_cast<VkBaseInStructure*>(before->pNext);
  }
  const VkBaseInStructure* features = before->pNext;
  if (features != nullptr) before->pNext = features->pNext;
  const VkResult result =
      TRISECT_NEXT(physical, vkCreateDevice)(physical, &without, allocator, device);
  if (features != nullptr) before->pNext = features;
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL get_report(VkDevice device, VkDeviceFaultCountsEXT* counts,
                                          VkDeviceFaultInfoEXT* info) {
  if (!is_lost(device)) give_up("vkGetDeviceFaultInfoEXT on a device that is not lost");
  counts->addressInfoCount = 1;
  counts->vendorInfoCount = 1;
  if (info == nullptr) return VK_SUCCESS;
  std::snprintf(info->description, sizeof(info->description), "a fault\nof the test");
  info->pAddressInfos[0] = {VK_DEVICE_FAULT_ADDRESS_TYPE_READ_INVALID_EXT, 0x12345678, 0x1000};
  VkDeviceFaultVendorInfoEXT& vendor = info->pVendorInfos[0];
  std::snprintf(vendor.description, sizeof(vendor.description), "an engine");
  vendor.vendorFaultCode = 0x2a;
  vendor.vendorFaultData = 7;
  return VK_SUCCESS;
}

}  // namespace fault_report

// SPIR-V of a compute shader that returns.
constexpr uint32_t kEmptyKernel[] = {
    0x07230203, 0x00010000, 0,  5,          0,     // header: five ids
    0x00020011, 1,                                 // OpCapability Shader
    0x0003000e, 0,          1,                     // OpMemoryModel Logical GLSL450
    0x0005000f, 5,          1,  0x6e69616d, 0,     // OpEntryPoint GLCompute %1 "main"
    0x00060010, 1,          17, 64,         1, 1,  // OpExecutionMode %1 LocalSize 64 1 1
    0x00020013, 2,                                 // %2 = OpTypeVoid
    0x00030021, 3,          2,                     // %3 = OpTypeFunction %2
    0x00050036, 2,          1,  0,          3,     // %1 = OpFunction %2 None %3
    0x000200f8, 4,                                 // OpLabel %4
    0x000100fd,                                    // OpReturn
    0x00010038};                                   // OpFunctionEnd

// Whether a module has an entry point for compute.
bool is_kernel(const VkShaderModuleCreateInfo& info) {
  constexpr uint32_t header = 5;
  constexpr uint32_t entry_point = 15;
  constexpr uint32_t compute = 5;
  const std::size_t words = info.codeSize / sizeof(uint32_t);
  for (std::size_t i = header; i + 1 < words; i += info.pCode[i] >> 16U) {
    if ((info.pCode[i] & 0xffffU) == entry_point) return info.pCode[i + 1] == compute;
  }
  return false;
}

VKAPI_ATTR VkResult VKAPI_CALL create_empty_kernel(VkDevice device,
                                                   const VkShaderModuleCreateInfo* info,
                                                   const VkAllocationCallbacks* allocator,
                                                   VkShaderModule* module) {
  VkShaderModuleCreateInfo changed = *info;
  constexpr std::size_t short_bytes = 8000;
  if (is_kernel(*info) && info->codeSize > short_bytes) {
    changed.codeSize = sizeof(kEmptyKernel);
    changed.pCode = kEmptyKernel;
  }
  return TRISECT_NEXT(device, vkCreateShaderModule)(device, &changed, allocator, module);
}

VKAPI_ATTR VkResult VKAPI_CALL get_no_time(VkDevice device, VkQueryPool pool, uint32_t first,
                                           uint32_t count, std::size_t size, void* data,
                                           VkDeviceSize stride, VkQueryResultFlags flags) {
  const auto next = TRISECT_NEXT(device, vkGetQueryPoolResults);
  const VkResult result = next(device, pool, first, count, size, data, stride, flags);
  std::memset(data, 0, size);
  return result;
}

// What a call that does not fail goes to.
PFN_vkVoidFunction below(void* handle, const char* name) {
  const std::string_view called(name);
  static const bool empty_kernels = !variable("TRISECT_TEST_EMPTY_KERNELS").empty();
  if (empty_kernels && called == "vkCreateShaderModule") {
    return reinterpret_cast<PFN_vkVoidFunction>(create_empty_kernel);
  }
  if (empty_kernels && called == "vkGetQueryPoolResults") {
    return reinterpret_cast<PFN_vkVoidFunction>(get_no_time);
  }
  if (fault_report::is_faked() && called == "vkCreateDevice") {
    return reinterpret_cast<PFN_vkVoidFunction>(fault_report::create_device);
  }
  if (fault_report::is_faked() && called == "vkEnumerateDeviceExtensionProperties") {
    return reinterpret_cast<PFN_vkVoidFunction>(fault_report::enumerate_extensions);
  }
  return next_function(handle, name);
}

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
    const auto next = reinterpret_cast<typename Tag::Function>(below(handle, Tag::name));
    return next(first, rest...);
  }
};

#define TRISECT_FAILING_HOOK(function) \
  TRISECT_HOOK(function, (Failing<Tag_##function, false>::call)),
#define TRISECT_LOSING_HOOK(function) TRISECT_HOOK(function, (Failing<Tag_##function, true>::call)),

}  // namespace

std::span<const Hook> hooks() {
  static const std::vector<Hook> all = [] {
    std::vector<Hook> list{TRISECT_FAILING(TRISECT_FAILING_HOOK)
                               TRISECT_LOSING(TRISECT_LOSING_HOOK)};
    if (!fault_report::is_faked()) return list;
    list.push_back(TRISECT_HOOK(vkGetPhysicalDeviceFeatures2, fault_report::get_features));
    list.push_back(TRISECT_HOOK(vkGetDeviceFaultInfoEXT, fault_report::get_report));
    list.back().always = true;
    return list;
  }();
  return all;
}

}  // namespace trisect::layer
