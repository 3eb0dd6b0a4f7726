// The Vulkan instance: which devices there are, and on request the messages of the validation
// layer.
#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "vk/capabilities.h"

namespace trisect::gpu {

// A description of a device for users.
struct DeviceReport {
  std::string name;
  std::string type;                // "cpu", "discrete gpu", ...
  std::string driver;              // name and version
  std::string api;                 // Vulkan version, "1.3.230"
  std::vector<std::string> lacks;  // what it would need to be usable; empty if it is usable
  int rank = 0;                    // by type; the highest is preferred if the user names no device

  [[nodiscard]] bool usable() const { return lacks.empty(); }
};

// The validation layer's messages, in order of arrival. The layer adds them from any thread: all
// functions are safe to call from several threads at once.
class MessageLog {
 public:
  void add(std::string message);
  [[nodiscard]] std::vector<std::string> messages() const;
  void clear();

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

// Its const functions are safe to call from several threads at once.
class Instance {
 public:
  // validation: with the Khronos validation layer, synchronisation validation included.
  // surface_extensions: instance extensions that the window system needs, if there is a window.
  // most: the newest Vulkan version to use of those that the loader has; the oldest is 1.1. Throws
  // NoDevice if there is no Vulkan driver, or no validation layer though it is asked for, and Error
  // if the driver fails.
  explicit Instance(bool validation, std::span<const char* const> surface_extensions = {},
                    uint32_t most = VK_API_VERSION_1_3);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  Instance(Instance&&) = delete;
  Instance& operator=(Instance&&) = delete;

  [[nodiscard]] VkInstance get() const { return instance_; }
  // One per physical device.
  [[nodiscard]] const std::vector<Capabilities>& devices() const { return devices_; }

  // One report per physical device, in the order of devices().
  [[nodiscard]] std::vector<DeviceReport> reports() const;

  [[nodiscard]] MessageLog& log() const { return *log_; }
  [[nodiscard]] bool can_name_objects() const { return debug_utils_; }

 private:
  void destroy();

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::unique_ptr<MessageLog> log_;
  std::vector<Capabilities> devices_;
  bool debug_utils_ = false;
};

// The index of the device to use. request: empty for the usable one of the highest rank; a number
// for the one with this index; else a part of its name, in any case. Throws NoDevice, with a list
// of all devices and what they lack, if none fits, if a name fits several, or if the device is not
// usable.
std::size_t choose_device(const std::vector<DeviceReport>& reports, const std::string& request);

}  // namespace trisect::gpu
