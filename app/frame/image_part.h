// A part of an image.
#pragma once

#include <cstdint>

namespace trisect {

// The most pixels along a side of an image, and the most rays along it with several per pixel.
constexpr uint32_t kLargestSide = 16384;

// A rectangle of an image's pixels: x, y: of its top left one, row 0 being the top.
struct ImagePart {
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t width = 0;
  uint32_t height = 0;

  bool operator==(const ImagePart&) const = default;

  // Whether it has pixels, all of them in an image of that size.
  [[nodiscard]] bool is_in(uint32_t image_width, uint32_t image_height) const {
    const auto fits = [](uint32_t first, uint32_t size, uint32_t whole) {
      return size >= 1 && size <= whole && first <= whole - size;
    };
    return fits(x, width, image_width) && fits(y, height, image_height);
  }
};

// Where a frame is in the image that it is, or is a part of.
struct FramePlace {
  uint32_t x = 0;  // of the frame's top left pixel
  uint32_t y = 0;
  uint32_t image_width = 0;
  uint32_t image_height = 0;
};

}  // namespace trisect
