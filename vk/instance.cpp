#include "vk/instance.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "vk/result.h"

namespace trisect::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// What a device must have, beside a queue with compute and unmet_needs() of nothing.
constexpr uint32_t kLeastVersion = VK_API_VERSION_1_1;

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                          VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* user) {
  static_cast<MessageLog*>(user)->add(data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(MessageLog* log) {
  VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = log;
  return info;
}

bool has_layer(const char* name) {
  uint32_t count = 0;
  TRISECT_VK(vkEnumerateInstanceLayerProperties(&count, nullptr));
  std::vector<VkLayerProperties> layers(count);
  TRISECT_VK(vkEnumerateInstanceLayerProperties(&count, layers.data()));
  return std::any_of(layers.begin(), layers.end(), [name](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, name) == 0;
  });
}

bool has_extension(const char* name) {
  uint32_t count = 0;
  TRISECT_VK(vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr));
  std::vector<VkExtensionProperties> extensions(count);
  TRISECT_VK(vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()));
  return std::any_of(extensions.begin(), extensions.end(), [name](const VkExtensionProperties& e) {
    return std::strcmp(e.extensionName, name) == 0;
  });
}

template <typename Function>
Function instance_function(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

std::string version_text(uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

struct TypeName {
  VkPhysicalDeviceType type;
  const char* name;
  int rank;
};
constexpr std::array<TypeName, 5> kTypes{{
    {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, "discrete gpu", 4},
    {VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU, "integrated gpu", 3},
    {VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, "virtual gpu", 2},
    {VK_PHYSICAL_DEVICE_TYPE_CPU, "cpu", 1},
    {VK_PHYSICAL_DEVICE_TYPE_OTHER, "other", 0},
}};

DeviceReport report_on(const Capabilities& device) {
  const VkPhysicalDeviceProperties& properties = device.properties;
  DeviceReport report;
  report.name = properties.deviceName;
  report.api = version_text(properties.apiVersion);
  report.driver = device.driver;
  for (const TypeName& entry : kTypes) {
    if (entry.type != properties.deviceType) continue;
    report.type = entry.name;
    report.rank = entry.rank;
  }
  if (device.version < kLeastVersion) {
    report.lacks.push_back("Vulkan " + version_text(kLeastVersion));
  }
  if (!device.compute_family) report.lacks.emplace_back("a compute queue");
  const std::vector<std::string> unmet = unmet_needs(properties.limits);
  report.lacks.insert(report.lacks.end(), unmet.begin(), unmet.end());
  return report;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

std::string list_of(const std::vector<DeviceReport>& reports) {
  std::string text;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    text += (i == 0 ? " " : "; ") + std::to_string(i) + " " + reports[i].name;
    for (std::size_t k = 0; k < reports[i].lacks.size(); ++k) {
      text += (k == 0 ? " lacks " : ", ") + reports[i].lacks[k];
    }
  }
  return text;
}

}  // namespace

void MessageLog::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> MessageLog::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

void MessageLog::clear() {
  const std::lock_guard lock(mutex_);
  messages_.clear();
}

Instance::Instance(bool validation, std::span<const char* const> surface_extensions, uint32_t most)
    : log_(std::make_unique<MessageLog>()) {
  if (validation && !has_layer(kValidationLayer)) {
    throw NoDevice(std::string("--validation needs the Vulkan layer ") + kValidationLayer +
                   ", which is not installed (Debian: vulkan-validationlayers).");
  }
  debug_utils_ = has_extension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (validation && !debug_utils_) {
    throw NoDevice("--validation needs the Vulkan extension " VK_EXT_DEBUG_UTILS_EXTENSION_NAME
                   ", which the loader does not have.");
  }
  std::vector<const char*> extensions(surface_extensions.begin(), surface_extensions.end());
  if (debug_utils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (validation) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  // Else the loader leaves out devices that lack some of what Vulkan promises (MoltenVK).
  const bool portability = has_extension(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
  if (portability) extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);

  uint32_t loader_version = 0;
  TRISECT_VK(vkEnumerateInstanceVersion(&loader_version));
  const uint32_t version = std::max(std::min(loader_version, most), kLeastVersion);
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "trisect";
  application.apiVersion = version;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  if (portability) info.flags = VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
  info.pApplicationInfo = &application;
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();

  const VkValidationFeatureEnableEXT synchronization =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(log_.get());
  if (validation) {
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    messenger.pNext = &features;
    info.pNext = &messenger;
  }
  const VkResult created = vkCreateInstance(&info, nullptr, &instance_);
  if (created == VK_ERROR_INCOMPATIBLE_DRIVER) {
    throw NoDevice(
        "no Vulkan driver is installed (Debian: mesa-vulkan-drivers has one for the CPU).");
  }
  check(created, "vkCreateInstance");

  try {
    if (validation) {
      messenger.pNext = nullptr;
      const auto create = instance_function<PFN_vkCreateDebugUtilsMessengerEXT>(
          instance_, "vkCreateDebugUtilsMessengerEXT");
      TRISECT_VK(create(instance_, &messenger, nullptr, &messenger_));
    }
    uint32_t count = 0;
    TRISECT_VK(vkEnumeratePhysicalDevices(instance_, &count, nullptr));
    std::vector<VkPhysicalDevice> devices(count);
    TRISECT_VK(vkEnumeratePhysicalDevices(instance_, &count, devices.data()));
    for (const VkPhysicalDevice device : devices) {
      devices_.push_back(capabilities_of(device, version));
    }
  } catch (...) {
    destroy();
    throw;
  }
}

Instance::~Instance() {
  destroy();
}

void Instance::destroy() {
  if (messenger_ != VK_NULL_HANDLE) {
    instance_function<PFN_vkDestroyDebugUtilsMessengerEXT>(
        instance_, "vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

std::vector<DeviceReport> Instance::reports() const {
  std::vector<DeviceReport> reports;
  std::transform(devices_.begin(), devices_.end(), std::back_inserter(reports), report_on);
  return reports;
}

std::size_t choose_device(const std::vector<DeviceReport>& reports, const std::string& request) {
  if (reports.empty()) {
    throw NoDevice(
        "no Vulkan device was found (Debian: mesa-vulkan-drivers has a driver for the CPU).");
  }
  std::vector<std::size_t> matches;
  const bool number =
      !request.empty() && request.find_first_not_of("0123456789") == std::string::npos;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const bool named = lower(reports[i].name).find(lower(request)) != std::string::npos;
    if (number ? request == std::to_string(i) : named) matches.push_back(i);
  }
  if (matches.empty()) {
    throw NoDevice("no Vulkan device is called '" + request + "'; there is" + list_of(reports) +
                   ".");
  }
  if (!request.empty() && matches.size() > 1) {
    throw NoDevice("'" + request + "' fits several Vulkan devices, name one by its number:" +
                   list_of(reports) + ".");
  }
  const auto best = std::max_element(matches.begin(), matches.end(), [&](auto a, auto b) {
    return std::pair(reports[a].usable(), reports[a].rank) <
           std::pair(reports[b].usable(), reports[b].rank);
  });
  if (!reports[*best].usable()) {
    throw NoDevice((request.empty() ? "no Vulkan device can be used:"
                                    : "the Vulkan device asked for cannot be used:") +
                   list_of(reports) + ".");
  }
  return *best;
}

}  // namespace trisect::gpu
