// What the comparison of two frames and its picture share.
#pragma once

#include <cstddef>

#include "app/frame/frame.h"

namespace trisect {

// Whether a pixel hit something: by its triangle, or, in a frame without AOVs, by its alpha.
bool is_hit(const Frame& frame, std::size_t pixel);

bool same_bits(float a, float b);

// Throws InputError if the frames are not of the same size.
void expect_same_size(const Frame& a, const Frame& b);

// How far apart: 0 for the same number, infinite or not, and for two that are no numbers (NaN); NaN
// if one is.
double apart(float a, float b);

// As FrameComparison has it, of colours and alpha.
struct ColorDifference {
  double rmse = 0.0;
  double largest = 0.0;         // NaN if any is
  double largest_number = 0.0;  // of those that are finite
  double alpha = 0.0;           // the largest where both hit or neither does
  std::size_t nan_pixels = 0;
};

// Of frames of the same size.
ColorDifference color_difference(const Frame& a, const Frame& b);

}  // namespace trisect
