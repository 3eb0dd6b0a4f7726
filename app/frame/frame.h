// A rendered image in host memory. Plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/surface/shared.h"

namespace trisect {

// Throws OutOfMemory if the machine has not the memory for an image of so many pixels, of so many
// bytes each. file: of what is read; empty for others.
void expect_pixels(std::size_t width, std::size_t height, std::size_t bytes,
                   const std::string& file = "");

// width times height pixels in rows from top to bottom, each row from left to right.
struct Frame {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<vec4>
      colors;  // red, green, blue, sRGB-encoded; w: 1 where a triangle was hit, else 0
  std::vector<PixelAovs> aovs;  // outputs beside colour, one for each pixel; empty if not asked for
  // Bytes of the scene that rays loaded on their way, added up over all rays; 0 if not counted.
  uint64_t bytes_read = 0;
  // Rays that a kernel left to a later one, added up over all kernels; 0 if they have no queue.
  uint64_t queued_rays = 0;

  // Throws OutOfMemory if the machine has not that much.
  void resize(uint32_t new_width, uint32_t new_height, bool with_aovs);

  [[nodiscard]] std::size_t hits() const {
    std::size_t count = 0;
    for (const vec4& color : colors) count += color.w > 0.0F ? 1 : 0;
    return count;
  }
};

}  // namespace trisect
