#include "app/frame/draw_text.h"

// Functions of this header that are not called here are no fault.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace trisect {

uint32_t draw_text(uint32_t x, uint32_t y, const std::string& text, const vec4& color,
                   Frame& frame) {
  // As stb_easy_font lays them out: rectangles of four corners each, the first and third of which
  // are opposite.
  struct Corner {
    float x;
    float y;
    float z;
    unsigned char color[4];
  };
  std::string letters = text;
  for (char& letter : letters) {
    if (letter < ' ' || letter > '~') letter = '?';
  }
  std::vector<Corner> corners(64 * (letters.size() + 1));
  const int count = stb_easy_font_print(0.0F, 0.0F, letters.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Corner)));
  const auto whole = [](float at) { return static_cast<uint32_t>(std::lround(at)); };
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const Corner& first = corners[4 * i];
    const Corner& last = corners[4 * i + 2];
    fill_rectangle(x + whole(first.x), y + whole(first.y), whole(last.x - first.x),
                   whole(last.y - first.y), color, frame);
  }
  return x + static_cast<uint32_t>(stb_easy_font_width(letters.data()));
}

void fill_rectangle(uint32_t x, uint32_t y, uint32_t width, uint32_t height, const vec4& color,
                    Frame& frame) {
  for (uint32_t row = y; row < std::min(y + height, frame.height); ++row) {
    for (uint32_t column = x; column < std::min(x + width, frame.width); ++column) {
      frame.colors[std::size_t{row} * frame.width + column] = color;
    }
  }
}

}  // namespace trisect
