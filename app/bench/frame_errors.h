// How wrong a frame is, in numbers that a frame with holes cannot look good in.
#pragma once

#include <cstddef>

#include "app/bake/bake.h"
#include "app/base/quantiles.h"
#include "app/frame/frame.h"
#include "app/oracle/oracle.h"

namespace trisect::bench {

// All but `undecidable` and the colours is about pixels that the oracle decides.
struct FrameErrors {
  std::size_t undecidable = 0;
  std::size_t wrong = 0;   // hit where the oracle misses
  std::size_t missed = 0;  // not hit where the oracle hits
  std::size_t nans = 0;
  // Where both hit:
  Quantiles off;             // |depth error| times |n.view|, over the scene's radius
  Quantiles depth_ulp;       // |depth error| in units in the last place
  Quantiles normal_degrees;  // between the geometric normals
  // Root of the mean square of `off` over the pixels that either hits, where a pixel that only one
  // of them hits, or that is farther off, counts as off by the radius.
  double rms = 0.0;
  // Between the outlines, the pixels on the borders of what is hit: from each of the frame's to the
  // nearest of the truth's, in pixels. A hole has an outline too.
  double outline_mean = 0.0;
  double outline_max = 0.0;
  // Of all pixels, in steps of 8 bits, and in decibels.
  double color_rmse = 0.0;
  double psnr = 0.0;
};

// frame: with AOVs. shown: frame_of(truth).
FrameErrors errors_of(const Frame& frame, const OracleFrame& truth, const Frame& shown,
                      const BakedScene& scene, const TraceParams& params);

}  // namespace trisect::bench
