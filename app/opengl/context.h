// An OpenGL 4.3 core context without a window, through EGL.
#pragma once

#include <string>

namespace trisect::opengl {

class Context {
 public:
  // Makes a context current on the calling thread: on EGL's surfaceless platform, or else on its
  // first device. Throws DeviceError if there is none with OpenGL 4.3.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  Context(Context&&) = delete;
  Context& operator=(Context&&) = delete;

  [[nodiscard]] const std::string& device() const { return device_; }  // GL_RENDERER
  [[nodiscard]] const std::string& driver() const { return driver_; }  // GL_VERSION

 private:
  // EGL's handles; its header stays out of this one.
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string device_;
  std::string driver_;
};

}  // namespace trisect::opengl
