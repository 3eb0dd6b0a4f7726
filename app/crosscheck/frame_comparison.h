// How far two frames of the same scene are apart.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/base/quantiles.h"
#include "app/crosscheck/tolerance.h"
#include "app/frame/frame.h"

namespace trisect {

// Of frames without AOVs, hits are told by alpha, and `depth` is empty.
struct FrameComparison {
  struct Depth {  // of pixels that both hit on the same triangle, but for the first
    std::size_t patch_mismatches = 0;  // hit by both, on different triangles
    std::size_t pixels = 0;
    std::size_t bit_equal = 0;  // Z of the same bits
    Quantiles ulp;              // |difference| of Z in units in the last place
    Quantiles normal_degrees;   // angle between the geometric normals
  };
  std::size_t pixels = 0;
  std::size_t hits = 0;            // of either
  std::size_t hit_mismatches = 0;  // hit by one only
  std::optional<Depth> depth;
  // Of all components of all colours, sRGB-encoded, in steps of 8 bits (1/255).
  double color_rmse = 0.0;
  double color_max = 0.0;
  double psnr = 0.0;  // decibels; infinite if the colours are the same
};

// Throws InputError if the sizes differ.
FrameComparison compare(const Frame& a, const Frame& b);

// What exceeds the tolerance, a phrase each.
std::vector<std::string> excesses(const FrameComparison& comparison, const Tolerance& tolerance);

// The figures, for a person.
std::string to_text(const FrameComparison& comparison);

// Four pictures in one: a, b, the difference of their colours, amplified so that the largest is
// white, and a mask: red where only one hits, yellow where they hit different triangles, blue where
// Z differs, grey where both hit the same.
Frame comparison_picture(const Frame& a, const Frame& b);

}  // namespace trisect
