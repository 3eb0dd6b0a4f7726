// The oracle as a back end: the same rays as the kernels', in double precision.
#pragma once

#include <optional>

#include "app/bake/bake.h"
#include "app/frame/frame.h"
#include "app/oracle/oracle.h"
#include "app/surface/shared.h"

namespace trisect {

// The ray through a pixel's centre, from the parameters' own numbers; t counts from the anchor, the
// point of the ray near the scene's centre.
struct OraclePixelRay {
  OracleRay ray;
  double anchor_distance;  // from the eye
};
OraclePixelRay oracle_pixel_ray(const TraceParams& params, uint32_t x, uint32_t y);

// An answer is undecidable if it flips when the ray moves sideways by this part of the distance
// from the eye to the anchor.
constexpr double kMotion = 1e-7;

// progress: as oracle_frame has it.
std::optional<OracleFrame> trace_with_oracle(const BakedScene& scene, const TraceParams& params,
                                             const Progress& progress);

// Whether light reaches what a ray along `view` met at these weights of a triangle: what it meets
// on its way to the light. Where the surface itself turns away from the light, that is the surface.
OracleAnswer oracle_shadow(const Oracle& oracle, const BakedScene& scene, const TraceParams& params,
                           uint32_t triangle, const glm::dvec3& weights, const glm::dvec3& view);

// Darkens the pixels of frame_of() that light does not reach. progress: as parallel_rows has it, of
// rows; false: it stopped the work.
bool cast_oracle_shadows(const OracleFrame& answers, const BakedScene& scene,
                         const TraceParams& params, Frame& frame, const Progress& progress);

// The answers as a frame, shaded as the robust solver's are, with AOVs; rounded to single
// precision.
Frame frame_of(const OracleFrame& answers, const BakedScene& scene, const TraceParams& params);

}  // namespace trisect
