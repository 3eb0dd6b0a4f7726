// Proven ranges of the sphere surface over a sub-triangle of a patch: shaders/sphere_range.glsl in
// double precision, where every operation rounds outward, and conclusions from them.
//
// Each range holds every value in exact arithmetic on the baked numbers and on the directions D_i
// as patch_of has them, for all weights in the hull of the sub-triangle's. The functions have no
// state and may be called from several threads.
#pragma once

#include <optional>

#include "app/base/interval.h"
#include "app/surface/patch_range.h"

namespace trisect {

// Range of |D|^2 over a sub-triangle. `corners`, here and below: corners_of(patch, part).
Interval direction_square_range(const Patch& patch, const CornerWeights& weights,
                                const PatchCorners& corners);

// Range of sigma, in units of D, over a sub-triangle; nothing where D may be shorter than 1e-10.
std::optional<Interval> sphere_sigma_range(const Patch& patch, const CornerWeights& weights,
                                           const PatchCorners& corners);

// Whether sigma is proven to be smooth over a sub-triangle, some of which may lie beyond the
// triangle's border: lines do not begin to miss a vertex's sphere there, and no height comes to its
// limit. False is no proof of the contrary.
bool sphere_is_smooth(const Patch& patch, const CornerWeights& weights);

// Ranges of sigma and of its derivatives along u and v, in units of D. Nothing where a height may
// be at its limit or its line may miss the sphere, and at a vertex, about which the derivatives of
// the curvature turn.
struct SigmaRanges {
  Interval s;
  Interval u;
  Interval v;
};
std::optional<SigmaRanges> sphere_derivative_ranges(const Patch& patch,
                                                    const CornerWeights& weights,
                                                    const PatchCorners& corners);

}  // namespace trisect
