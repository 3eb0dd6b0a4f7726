// What a surface is made of.
#pragma once

#include "app/surface/shared.h"

namespace trisect {

// As the command line and the JSON name them.
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
