// The Vulkan instance: the devices that are there, and the messages of the validation layer on
// request.
#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace trisect::gpu {

// What a user sees of a device, and why it cannot be used if it cannot.
struct DeviceReport {
  std::string name;
  std::string type;    // "cpu", "discrete gpu", ...
  std::string driver;  // name and version
  std::string api;     // Vulkan version, "1.3.230"
  std::vector<std::string> lacks;
  int rank = 0;  // higher is preferred when nothing is asked for

  [[nodiscard]] bool usable() const { return lacks.empty(); }
};

// The validation layer's messages, in order of arrival. Filled from the driver's threads.
class MessageLog {
 public:
  void add(std::string message);
  [[nodiscard]] std::vector<std::string> messages() const;
  void clear();

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

class Instance {
 public:
  // validation: the Khronos layer with synchronisation validation. surface_extensions: what a
  // window system needs to show pictures, for a program that does. Throws NoDevice if there is no
  // Vulkan driver at all, or no validation layer where one is asked for.
  explicit Instance(bool validation, std::span<const char* const> surface_extensions = {});
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  Instance(Instance&&) = delete;
  Instance& operator=(Instance&&) = delete;

  [[nodiscard]] VkInstance get() const { return instance_; }
  [[nodiscard]] const std::vector<VkPhysicalDevice>& physical_devices() const { return devices_; }

  // One report per physical device, in the driver's order.
  [[nodiscard]] std::vector<DeviceReport> reports() const;

  [[nodiscard]] MessageLog& log() const { return *log_; }
  [[nodiscard]] bool can_name_objects() const { return debug_utils_; }

 private:
  void destroy();

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::unique_ptr<MessageLog> log_;
  std::vector<VkPhysicalDevice> devices_;
  bool debug_utils_ = false;
};

// The queue family with compute that a device offers, or -1.
int compute_family(VkPhysicalDevice device);

// Which of `reports` to use: the preferred usable one if request is empty, the one of that number,
// or the only one whose name contains the request (letter case aside). Throws NoDevice, listing
// every device with what it lacks.
std::size_t choose_device(const std::vector<DeviceReport>& reports, const std::string& request);

}  // namespace trisect::gpu
