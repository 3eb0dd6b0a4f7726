#include "app/frame/frame.h"

#include <fmt/format.h>

#include "app/base/memory.h"

namespace trisect {

void expect_pixels(std::size_t width, std::size_t height, std::size_t bytes,
                   const std::string& file) {
  expect_memory(
      static_cast<double>(width * height) * static_cast<double>(bytes),
      fmt::format("{}{}an image of {}x{} pixels", file, file.empty() ? "" : ": ", width, height));
}

void Frame::resize(uint32_t new_width, uint32_t new_height, bool with_aovs) {
  const std::size_t pixels = std::size_t{new_width} * new_height;
  if (pixels > colors.capacity() || (with_aovs && pixels > aovs.capacity())) {
    expect_pixels(new_width, new_height, sizeof(vec4) + (with_aovs ? sizeof(PixelAovs) : 0));
  }
  width = new_width;
  height = new_height;
  bytes_read = 0;
  queued_rays = 0;
  colors.resize(pixels);
  aovs.resize(with_aovs ? pixels : 0);
}

}  // namespace trisect
