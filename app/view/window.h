// A window of the desktop, by GLFW: its input, cursor and clipboard, and its Vulkan surface.
#pragma once

#include <vulkan/vulkan.h>

// After Vulkan's header, so that it declares its functions for Vulkan.
#include <GLFW/glfw3.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "vk/instance.h"

namespace trisect::view {

struct KeyPress {
  int key;   // GLFW_KEY_...
  int mods;  // GLFW_MOD_...
};

// What has happened in the window since it was last asked.
struct Input {
  bool any = false;  // anything that may change the picture or the panel
  // Something that probably changes the picture, so that a refinement in progress is not worth
  // finishing: everything but a motion of the mouse without a button.
  bool ends_refinement = false;
  bool resized = false;
  double wheel = 0.0;  // steps, away from the user positive
  std::vector<KeyPress> keys;
  std::vector<std::string> dropped;  // files that were dragged into the window
};

// There can be one window at a time. Of the main thread only, as GLFW is.
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

  // In pixels; 0 while the window is minimised.
  [[nodiscard]] uint32_t width() const;
  [[nodiscard]] uint32_t height() const;
  void resize(uint32_t width, uint32_t height);

  void set_title(const std::string& title);

  // Whether the user or close() wants the window closed. It stays open until it is destroyed.
  [[nodiscard]] bool is_closing() const;
  void close();

  // Handles the events that have come. With seconds > 0 it first waits for one, so long at most.
  void wait(double seconds);

  // What has come since the last call.
  Input take();
  // Whether something of it ends a refinement; see Input.
  [[nodiscard]] bool has_input_that_ends_refinement() const { return input_.ends_refinement; }

  // What is held now. key: GLFW_KEY_...
  [[nodiscard]] bool is_key_down(int key) const;
  [[nodiscard]] bool is_left_button_down() const;

  // Position of the cursor in pixels, to the right and down. While the cursor is captured it is
  // hidden and moves without bounds.
  [[nodiscard]] glm::dvec2 cursor() const;
  void capture_cursor(bool captured);

  [[nodiscard]] std::string clipboard() const;
  void set_clipboard(const std::string& text);

 private:
  GLFWwindow* window_ = nullptr;
  std::string title_;
  Input input_;
};

// What Vulkan calls a surface: where a device shows pictures in the window.
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
