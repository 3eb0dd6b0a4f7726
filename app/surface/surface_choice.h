// What a surface is made of.
#pragma once

#include "app/shared.h"

namespace trisect {

struct SurfaceChoice {
  uint surface = SURFACE_PHONG;
  double alpha = 0.65;  // phong only
  uint shell = SHELL_NORMAL;

  bool operator==(const SurfaceChoice&) const = default;
};

}  // namespace trisect
