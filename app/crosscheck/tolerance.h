// How far two frames of the same scene may be apart.
#pragma once

namespace trisect {

// A NaN is always too much. Left as it is, anything goes.
struct Tolerance {
  static constexpr double kAny = 1e300;
  double hit_mismatches = kAny;    // parts of the pixels
  double patch_mismatches = kAny;  // parts of the pixels
  double z_differs = kAny;         // parts of the pixels that both hit
  double color_rmse = kAny;        // steps of 8 bits
  double color_max = kAny;
};

}  // namespace trisect
