#include "app/view/window.h"

#include <utility>
#include "app/base/error.h"

#include "vk/result.h"

namespace trisect::view {
namespace {

Input& input_of(GLFWwindow* window) {
  Input& input = *static_cast<Input*>(glfwGetWindowUserPointer(window));
  input.any = true;
  input.disturbs = true;
  return input;
}

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason is known" : text;
}

}  // namespace

Window::Window(uint32_t width, uint32_t height, const std::string& title) {
  if (glfwInit() != GLFW_TRUE) {
    throw NoDevice("trisect view needs a display: " + last_error() +
                   "; trisect render needs none.");
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  window_ = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(),
                             nullptr, nullptr);
  if (window_ == nullptr || glfwVulkanSupported() != GLFW_TRUE) {
    const std::string reason =
        window_ == nullptr ? last_error() : "the Vulkan loader knows no surface for this display";
    glfwTerminate();
    throw NoDevice("no window could be opened: " + reason + ".");
  }
  glfwSetWindowUserPointer(window_, &input_);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
    Input& input = input_of(window);
    if (action == GLFW_PRESS) input.keys.push_back({key, mods});
  });
  glfwSetScrollCallback(window_,
                        [](GLFWwindow* window, double, double y) { input_of(window).wheel += y; });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    Input& input = input_of(window);
    input.dropped.insert(input.dropped.end(), paths, paths + count);
  });
  glfwSetFramebufferSizeCallback(
      window_, [](GLFWwindow* window, int, int) { input_of(window).resized = true; });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double, double) {
    Input& input = *static_cast<Input*>(glfwGetWindowUserPointer(window));
    input.any = true;
    // With a button it turns the camera or works the panel.
    const bool pressed = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    input.disturbs = input.disturbs || pressed;
  });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* window) { input_of(window); });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int, int, int) { input_of(window); });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { input_of(window); });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int) { input_of(window); });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned int) { input_of(window); });
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

std::vector<const char*> Window::vulkan_extensions() const {
  uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  return {names, names + count};
}

uint32_t Window::width() const {
  int width = 0;
  glfwGetFramebufferSize(window_, &width, nullptr);
  return static_cast<uint32_t>(width);
}

uint32_t Window::height() const {
  int height = 0;
  glfwGetFramebufferSize(window_, nullptr, &height);
  return static_cast<uint32_t>(height);
}

void Window::resize(uint32_t width, uint32_t height) {
  glfwSetWindowSize(window_, static_cast<int>(width), static_cast<int>(height));
}

void Window::wait(double seconds) {
  if (seconds > 0.0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
}

Input Window::take() {
  return std::exchange(input_, {});
}

Surface::Surface(const gpu::Instance& instance, const Window& window) : instance_(instance.get()) {
  TRISECT_VK(glfwCreateWindowSurface(instance_, window.get(), nullptr, &surface_));
}

}  // namespace trisect::view
