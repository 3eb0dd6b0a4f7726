// How wrong a frame is. Holes count as errors here, so that a contender gains nothing by leaving
// out what it cannot draw.
#pragma once

#include <cstddef>

#include "app/bake/bake.h"
#include "app/base/quantiles.h"
#include "app/frame/frame.h"
#include "app/oracle/oracle.h"

namespace trisect::bench {

struct OutlineErrors {
  double mean = 0.0;
  double max = 0.0;
};

// From each pixel of the frame's outline to the nearest one of the true outline, in pixels. The
// outline are the hit pixels next to one that is not hit, so a hole has an outline, too. 0 if
// either frame hits nothing. Both frames have AOVs.
OutlineErrors outline_errors(const Frame& frame, const Frame& truth);

// Unless said otherwise of the pixels that the oracle decides. Pixels are judged by classify(), but
// a wrong patch or root counts by its distance only: what is compared here includes flat triangles
// that stand for curved ones, whose hits near an edge are often the neighbour's.
struct FrameErrors {
  std::size_t undecidable = 0;  // of the oracle's answers
  std::size_t wrong = 0;        // hit where the oracle misses
  std::size_t missed = 0;       // not hit where the oracle hits
  std::size_t nans = 0;         // of all pixels; these count in none of the two above
  // Where the frame and the oracle both hit:
  Quantiles off;             // |depth error| |n.d| over the scene's radius
  Quantiles depth_ulp;       // |depth error| in units in the last place of the depth
  Quantiles normal_degrees;  // angle between the geometric normals
  // Root mean square of `off` over the pixels that the frame or the oracle hits. A pixel that only
  // one of them hits, that is NaN, or that is off by more counts as off by the radius, which is 1.
  double rms = 0.0;
  OutlineErrors outline;  // undecidable pixels are not left out
  // Of the colours of all pixels: in steps of 8 bits (1/255), and in decibels.
  double color_rmse = 0.0;
  double psnr = 0.0;
};

// frame: with AOVs, of truth's size, rendered with params. shown: frame_of(truth).
FrameErrors errors_of(const Frame& frame, const OracleFrame& truth, const Frame& shown,
                      const BakedScene& scene, const TraceParams& params);

}  // namespace trisect::bench
