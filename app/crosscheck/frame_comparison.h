// Compares two frames of the same scene, pixel by pixel. All functions are thread-safe.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/base/quantiles.h"
#include "app/crosscheck/tolerance.h"
#include "app/frame/frame.h"

namespace trisect {

// If either frame has no AOVs, its hits are told by its alpha, and `depth` is empty.
struct FrameComparison {
  struct Depth {
    std::size_t patch_mismatches = 0;  // pixels that the frames hit on different triangles
    std::size_t pixels = 0;            // pixels that both hit on the same triangle; of these:
    std::size_t bit_equal = 0;  // whose Z, the distance from the eye, is the same bit for bit
    Quantiles z_apart;          // |difference of Z|, in the model's units
    Quantiles ulp;              // the same in units in the last place of the first frame's
    Quantiles normal_degrees;   // angle between the geometric normals
  };
  std::size_t pixels = 0;
  // Whether the frames say what is hit: not if they are images without AOVs and without a pixel
  // that is transparent. The hits below are then all pixels.
  bool tells_hits = false;
  std::size_t hits = 0;            // hit by either frame
  std::size_t hit_mismatches = 0;  // hit by one only
  std::optional<Depth> depth;
  // Over the three components of all colours, sRGB-encoded, in steps of 8 bits (1/255). NaN if a
  // colour is in one of them.
  double color_rmse = 0.0;
  double color_max = 0.0;  // largest difference of a component
  // The same of alpha where both hit or neither does; an image without it is opaque.
  double alpha_max = 0.0;
  // Pixels with a colour's component that is NaN in both, which counts as equal.
  std::size_t nan_pixels = 0;
  double psnr = 0.0;  // peak signal-to-noise ratio, decibels; infinite if the colours are equal
};

// Throws InputError if the frames are not of the same size.
FrameComparison compare(const Frame& a, const Frame& b);

// One phrase for each figure that exceeds the tolerance; empty if none does.
std::vector<std::string> excesses(const FrameComparison& comparison, const Tolerance& tolerance);

// All figures as lines of text, for a person to read.
std::string to_text(const FrameComparison& comparison);

}  // namespace trisect
