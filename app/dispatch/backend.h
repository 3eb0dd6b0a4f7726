// Who traces a frame.
#pragma once

namespace trisect {

enum class Backend { vulkan, opengl, cpu, oracle };

// How OpenGL traces: the kernel of Vulkan, or the thesis's full-screen quad.
enum class GlPath { compute, fragment };

// As the command line and the JSON name it.
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

}  // namespace trisect
