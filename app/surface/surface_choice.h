// Which of the surfaces of shaders/surface.glsl a scene has.
#pragma once

#include "app/surface/shared.h"

namespace trisect {

// The names in the command line and in JSON.
constexpr const char* surface_name(uint surface) {
  return surface == SURFACE_FLAT ? "flat" : surface == SURFACE_PHONG ? "phong" : "sphere";
}
constexpr const char* shell_name(uint shell) {
  return shell == SHELL_HEIGHT ? "height" : "normal";
}

struct SurfaceChoice {
  uint surface = SURFACE_PHONG;
  double alpha = 0.65;  // phong only
  uint shell = SHELL_NORMAL;

  bool operator==(const SurfaceChoice&) const = default;
};

}  // namespace trisect
