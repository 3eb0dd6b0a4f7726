// The oracle as a back end: the rays of the kernels, in double precision.
#pragma once

#include <optional>

#include "app/bake/bake.h"
#include "app/frame/frame.h"
#include "app/oracle/oracle.h"
#include "app/surface/shared.h"

namespace trisect {

// The ray through a pixel's centre, computed from the parameters in single precision as the kernels
// have them; t counts from the point of the ray at depth 0 of the camera's frame.
struct OraclePixelRay {
  OracleRay ray;
  double anchor_distance;  // of that point from the eye
};
OraclePixelRay oracle_pixel_ray(const TraceParams& params, uint32_t x, uint32_t y);

// An answer is undecidable if it flips when the ray moves sideways by this part of the distance
// from the eye to the anchor.
constexpr double kMotion = 1e-7;

// The oracle's answer for each pixel, on all cores. progress: as oracle_frame has it.
std::optional<OracleFrame> trace_with_oracle(const BakedScene& scene, const TraceParams& params,
                                             const Progress& progress);

// The answer of the shadow ray from what a ray along `view` met at these weights of a triangle: a
// hit is in the way of the light. Where the surface faces away from the light the answer is the
// surface itself.
OracleAnswer oracle_shadow(const Oracle& oracle, const BakedScene& scene, const TraceParams& params,
                           uint32_t triangle, const glm::dvec3& weights, const glm::dvec3& view);

// Gives the pixels of frame_of() that are in shadow the shadow's colour, on all cores. progress
// counts rows, as parallel_rows has it; returns false if it stopped the work.
bool cast_oracle_shadows(const OracleFrame& answers, const BakedScene& scene,
                         const TraceParams& params, Frame& frame, const Progress& progress);

// The answers as a frame with AOVs, rounded to single precision and shaded as the robust solver's
// hits are.
Frame frame_of(const OracleFrame& answers, const BakedScene& scene, const TraceParams& params);

}  // namespace trisect
