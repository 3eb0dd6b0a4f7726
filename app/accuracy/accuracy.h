// How far a frame is off the oracle's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "app/bake/bake.h"
#include "app/base/quantiles.h"
#include "app/frame/frame.h"
#include "app/oracle/oracle.h"
#include "app/surface/shared.h"

namespace trisect {

// All but `undecidable` is about decidable pixels only.
struct Accuracy {
  std::size_t pixels = 0;
  std::size_t hits = 0;  // of the oracle
  std::size_t undecidable = 0;
  std::size_t wrong_hits = 0;     // hit where the oracle misses
  std::size_t missed = 0;         // no hit where the oracle has one
  std::size_t wrong_patches = 0;  // another triangle at another depth
  std::size_t nans = 0;
  // Where both hit the same surface:
  Quantiles off_surface;  // |depth error| times |n.view|, over the scene's radius
  Quantiles depth_ulp;    // |depth error| in units in the last place of the depth
  Quantiles normal_degrees;
  // Evaluations for each candidate, of pixels that have any; 0 if they were not counted.
  double median_evaluations = 0.0;
};

// Two triangles whose depths agree to this part of the scene's radius share an edge there: a tie.
constexpr double kTie = 1e-6;

// A colour or an output that is not a number.
bool has_nan(const vec4& color, const PixelAovs& aov);

// Of a pixel's depth, where both the frame and the oracle hit.
struct PixelError {
  double off_surface;  // |depth error| times |n.view|
  double depth_ulp;    // |depth error| in units in the last place of the depth
};
PixelError pixel_error(const TraceParams& params, uint32_t x, uint32_t y,
                       const OracleAnswer& answer, const PixelAovs& aov);

// frame: with AOVs, of the same size. Throws std::logic_error if it is not.
Accuracy accuracy_of(const Frame& frame, const OracleFrame& truth, const BakedScene& scene,
                     const TraceParams& params);

}  // namespace trisect
