// An OpenGL 4.3 core context without a window, through EGL.
#pragma once

#include <string>

namespace trisect::opengl {

// What is made while a context is current must be destroyed before it, on the same thread.
class Context {
 public:
  // Makes the context current on the calling thread: that of EGL's surfaceless platform, or if
  // there is none, of EGL's first device. Throws DeviceError if there is no OpenGL 4.3.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  Context(Context&&) = delete;
  Context& operator=(Context&&) = delete;

  [[nodiscard]] const std::string& device() const { return device_; }  // GL_RENDERER
  [[nodiscard]] const std::string& driver() const { return driver_; }  // GL_VERSION

 private:
  // EGLDisplay and EGLContext, which are pointers: EGL's header would define macros for all users.
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string device_;
  std::string driver_;
};

}  // namespace trisect::opengl
