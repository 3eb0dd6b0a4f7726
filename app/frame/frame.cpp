#include "app/frame/frame.h"

#include <fmt/format.h>

#include "app/base/memory.h"

namespace trisect {

void Frame::resize(uint32_t new_width, uint32_t new_height, bool with_aovs) {
  const std::size_t pixels = std::size_t{new_width} * new_height;
  if (pixels > colors.capacity() || (with_aovs && pixels > aovs.capacity())) {
    const std::size_t bytes = sizeof(vec4) + (with_aovs ? sizeof(PixelAovs) : 0);
    expect_memory(static_cast<double>(pixels) * static_cast<double>(bytes),
                  fmt::format("an image of {}x{} pixels", new_width, new_height));
  }
  width = new_width;
  height = new_height;
  bytes_read = 0;
  queued_rays = 0;
  colors.resize(pixels);
  aovs.resize(with_aovs ? pixels : 0);
}

}  // namespace trisect
