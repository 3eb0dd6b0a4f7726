// A window and what happens in it.
#pragma once

#include <vulkan/vulkan.h>

// After Vulkan's header, of which it then knows.
#include <GLFW/glfw3.h>

#include <cstdint>
#include <string>
#include <vector>

#include "vk/instance.h"

namespace trisect::view {

struct KeyPress {
  int key;   // GLFW_KEY_...
  int mods;  // GLFW_MOD_...
};

// What came since the last look.
struct Input {
  bool any = false;       // anything that may change the picture or the panel
  bool disturbs = false;  // more than the mere motion of the mouse
  bool resized = false;
  double wheel = 0.0;  // steps, away from the user positive
  std::vector<KeyPress> keys;
  std::vector<std::string> dropped;  // files
};

class Window {
 public:
  // Throws NoDevice if there is no display.
  Window(uint32_t width, uint32_t height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  Window(Window&&) = delete;
  Window& operator=(Window&&) = delete;

  [[nodiscard]] GLFWwindow* get() const { return window_; }
  [[nodiscard]] std::vector<const char*> vulkan_extensions() const;

  // In pixels; 0 while it is minimised.
  [[nodiscard]] uint32_t width() const;
  [[nodiscard]] uint32_t height() const;
  void resize(uint32_t width, uint32_t height);

  // Waits until something happens or so many seconds have passed; 0: does not wait.
  void wait(double seconds);

  Input take();
  // Whether something came that a picture in the making should not outlast: not the mere motion of
  // the mouse.
  [[nodiscard]] bool is_disturbed() const { return input_.disturbs; }

 private:
  GLFWwindow* window_ = nullptr;
  Input input_;
};

// A window's place where a device shows pictures.
class Surface {
 public:
  // Throws DeviceError.
  Surface(const gpu::Instance& instance, const Window& window);
  ~Surface() { vkDestroySurfaceKHR(instance_, surface_, nullptr); }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  Surface(Surface&&) = delete;
  Surface& operator=(Surface&&) = delete;

  [[nodiscard]] VkSurfaceKHR get() const { return surface_; }

 private:
  VkInstance instance_;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
};

}  // namespace trisect::view
