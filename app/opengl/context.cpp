#include "app/opengl/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

#include "app/base/error.h"
#include "app/opengl/gl.h"

namespace trisect::opengl {
namespace {

EGLDisplay initialized(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
    return EGL_NO_DISPLAY;
  }
  return display;
}

EGLDisplay surfaceless_display() {
  return initialized(
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
}

EGLDisplay device_display() {
  const auto query =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  EGLDeviceEXT device = nullptr;
  EGLint count = 0;
  if (query == nullptr || query(1, &device, &count) != EGL_TRUE || count == 0) {
    return EGL_NO_DISPLAY;
  }
  return initialized(eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
}

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace

Context::Context() {
  display_ = surfaceless_display();
  if (display_ == EGL_NO_DISPLAY) display_ = device_display();
  if (display_ == EGL_NO_DISPLAY) {
    throw DeviceError("EGL offers neither a surfaceless display nor a device.");
  }
  eglBindAPI(EGL_OPENGL_API);
  const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         4,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         3,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
  context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
  const bool current =
      context_ != EGL_NO_CONTEXT &&
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  if (!current) {
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
    throw DeviceError("EGL offers no OpenGL 4.3 core context without a surface.");
  }
  device_ = text_of(GL_RENDERER);
  driver_ = "OpenGL " + text_of(GL_VERSION);
}

Context::~Context() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

}  // namespace trisect::opengl
