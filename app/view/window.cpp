#include "app/view/window.h"

#include <dlfcn.h>

#include <utility>

#include "app/base/error.h"
#include "app/cli/interrupt.h"
#include "vk/result.h"

namespace trisect::view {
namespace {

// Where a callback writes the input that it was called for.
Input& input_of(GLFWwindow* window) {
  Input& input = *static_cast<Input*>(glfwGetWindowUserPointer(window));
  input.any = true;
  input.ends_refinement = true;
  return input;
}

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason is known" : text;
}

// What Xlib does when its server goes would be a text of its own and exit code 1.
void tell_when_the_display_goes() {
  // GLFW has loaded it if it uses it.
  void* xlib = dlopen("libX11.so.6", RTLD_NOW | RTLD_NOLOAD);
  if (xlib == nullptr) return;
  using Handler = int (*)(void* display);
  const auto set_handler =
      reinterpret_cast<Handler (*)(Handler)>(dlsym(xlib, "XSetIOErrorHandler"));
  if (set_handler == nullptr) return;
  // It must not return.
  set_handler([](void* /*display*/) -> int {
    end_at_once(exit_no_device, "the display has gone, and the window with it.");
  });
}

}  // namespace

Window::Window(uint32_t width, uint32_t height, const std::string& title) : title_(title) {
  if (glfwInit() != GLFW_TRUE) {
    throw NoDevice("trisect view needs a display: " + last_error() +
                   "; trisect render needs none.");
  }
  tell_when_the_display_goes();
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
    // With the button held the motion turns the camera or works the panel.
    const bool pressed = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    input.ends_refinement = input.ends_refinement || pressed;
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

void Window::set_title(const std::string& title) {
  // Every change comes back as an event, which would end a wait.
  if (title_ == title) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

bool Window::is_closing() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
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

bool Window::is_key_down(int key) const {
  return glfwGetKey(window_, key) == GLFW_PRESS;
}

bool Window::is_left_button_down() const {
  return glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
}

glm::dvec2 Window::cursor() const {
  glm::dvec2 cursor;
  glfwGetCursorPos(window_, &cursor.x, &cursor.y);
  return cursor;
}

void Window::capture_cursor(bool captured) {
  glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text == nullptr ? "" : text;
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

Surface::Surface(const gpu::Instance& instance, const Window& window) : instance_(instance.get()) {
  TRISECT_VK(glfwCreateWindowSurface(instance_, window.get(), nullptr, &surface_));
}

}  // namespace trisect::view
