// A rendered image in host memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/surface/shared.h"

namespace trisect {

// Rows from top to bottom, pixels from left to right.
struct Frame {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<vec4> colors;     // sRGB-encoded red, green, blue; 1 where a triangle was hit, else 0
  std::vector<PixelAovs> aovs;  // empty if they were not asked for
  uint64_t bytes_read = 0;      // of the scene by its rays, each its own; 0 if that is not counted

  void resize(uint32_t new_width, uint32_t new_height, bool with_aovs) {
    width = new_width;
    height = new_height;
    bytes_read = 0;
    colors.resize(std::size_t{width} * height);
    aovs.resize(with_aovs ? colors.size() : 0);
  }

  [[nodiscard]] std::size_t hits() const {
    std::size_t count = 0;
    for (const vec4& color : colors) count += color.w > 0.0F ? 1 : 0;
    return count;
  }
};

}  // namespace trisect
