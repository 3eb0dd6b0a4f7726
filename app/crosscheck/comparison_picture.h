// Two frames and their differences as one picture.
#pragma once

#include <cstdint>
#include <string>

#include "app/frame/frame.h"

namespace trisect {

// The rows below the four pictures.
constexpr uint32_t kComparisonKeyHeight = 16;

// Four pictures in one, twice as wide and high as the frames: a and b above; below them the
// difference of their colours, amplified so that the largest is white, and a mask of the hits. The
// mask is red where only one frame hits, yellow where they hit different triangles, blue where Z
// differs, grey where they hit alike, black where neither hits. Under them kComparisonKeyHeight
// rows that say so: the scale of the difference, in steps of 8 bits, and the mask's colours. Throws
// InputError if the frames are not of the same size.
Frame comparison_picture(const Frame& a, const Frame& b);

// What the scale of comparison_picture() is: "185 of 255, x1.38", and whether some differences are
// not finite.
std::string comparison_scale(const Frame& a, const Frame& b);

}  // namespace trisect
