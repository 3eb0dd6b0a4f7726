// The back ends, which all trace the same frame.
#pragma once

namespace trisect {

enum class Backend { vulkan, opengl, cpu, oracle };

// How the OpenGL back end traces: by a compute shader, the source of Vulkan's kernel, or by the
// fragments of a full-screen quad, as in the thesis.
// Whether it traces on a device, not in threads of this process.
constexpr bool is_device(Backend backend) {
  return backend == Backend::vulkan || backend == Backend::opengl;
}

enum class GlPath { compute, fragment };

// Names as on the command line and in JSON.
constexpr const char* backend_name(Backend backend) {
  switch (backend) {
    case Backend::vulkan:
      return "vulkan";
    case Backend::opengl:
      return "opengl";
    case Backend::cpu:
      return "cpu";
    case Backend::oracle:
      return "oracle";
  }
  return "";
}

constexpr const char* gl_path_name(GlPath path) {
  return path == GlPath::fragment ? "fragment" : "compute";
}

}  // namespace trisect
