// How much two frames of the same scene may differ.
#pragma once

namespace trisect {

// The largest difference that is allowed, for each figure of a FrameComparison. A figure that is
// NaN exceeds every limit. The default allows any difference that is not NaN.
struct Tolerance {
  static constexpr double kAny = 1e300;
  double hit_mismatches = kAny;    // as a fraction of the pixels
  double patch_mismatches = kAny;  // as a fraction of the pixels
  // Pixels whose Z is not equal bit for bit, as a fraction of those that both frames hit on the
  // same triangle.
  double z_differs = kAny;
  double color_rmse = kAny;  // in steps of 8 bits (1/255)
  double color_max = kAny;   // in steps of 8 bits
  double alpha_max = kAny;   // in steps of 8 bits
  double nan_pixels = kAny;  // as a fraction of the pixels
};

}  // namespace trisect
