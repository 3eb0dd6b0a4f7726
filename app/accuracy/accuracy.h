// How far a rendered frame is from the oracle's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "app/accuracy/classify.h"
#include "app/bake/bake.h"
#include "app/base/quantiles.h"
#include "app/frame/frame.h"
#include "app/oracle/oracle.h"
#include "app/surface/shared.h"

namespace trisect {

// Counts are of pixels.
struct Accuracy {
  std::size_t pixels = 0;
  std::size_t hits = 0;         // of the oracle, decidable or not
  std::size_t undecidable = 0;  // of the oracle's answers
  std::size_t nans = 0;         // among the undecidable pixels, too
  // Of the decidable pixels without a NaN:
  std::size_t wrong_hits = 0;     // hit where the oracle misses
  std::size_t missed = 0;         // no hit where the oracle has one
  std::size_t wrong_patches = 0;  // another triangle at another depth
  // Of those that both hit on the same triangle, even if on another root of it, or on triangles
  // that tie:
  Quantiles off_surface;  // |depth error| |n.d| over the scene's radius
  Quantiles depth_ulp;    // |depth error| in units in the last place of the depth
  // Angle between the geometric normals, in degrees. Ties are left out: the two triangles that
  // share an edge have different normals there.
  Quantiles normal_degrees;
  // Median over the pixels that have candidates of the evaluations for each candidate; 0 if the
  // frame was traced without counting them.
  double median_evaluations = 0.0;
};

// Judges one pixel, numbered row by row as in both frames, by the rules of classify(). A NaN is one
// in the pixel's colour or AOVs. frame: with AOVs, of truth's size, rendered with params. radius:
// the scene's. Safe to call from several threads.
ClassifiedRay classify_pixel(const Frame& frame, const OracleFrame& truth, std::size_t pixel,
                             const TraceParams& params, double radius);

// frame: with AOVs, of truth's size, rendered of this scene with params. Throws std::logic_error if
// it has no AOVs or another size. Safe to call from several threads.
Accuracy accuracy_of(const Frame& frame, const OracleFrame& truth, const BakedScene& scene,
                     const TraceParams& params);

}  // namespace trisect
