// Letters in a frame.
#pragma once

#include <cstdint>
#include <string>

#include "app/frame/frame.h"

namespace trisect {

// The height of a line of letters, in pixels.
constexpr uint32_t kTextHeight = 12;

// Draws ASCII text, whose top left corner is at (x, y), in that colour. What does not fit into the
// frame is left out. Returns where the text ends, in pixels from the left.
uint32_t draw_text(uint32_t x, uint32_t y, const std::string& text, const vec4& color,
                   Frame& frame);

// Fills a rectangle, as far as it is in the frame.
void fill_rectangle(uint32_t x, uint32_t y, uint32_t width, uint32_t height, const vec4& color,
                    Frame& frame);

}  // namespace trisect
