// Ranges of the sphere surface over a part of a patch, by interval arithmetic on its closed form
// (shaders/surface.glsl).
#pragma once

#include <optional>

#include "app/base/interval.h"
#include "app/surface/patch_range.h"

namespace trisect {

// Range of |D|^2 over a part.
Interval direction_square_range(const Patch& patch, const PartCorners& corners);

// Range of sigma, in units of D, over a part; nothing where D may vanish.
std::optional<Interval> sphere_sigma_range(const Patch& patch, const Part& part,
                                           const PartCorners& corners);

// Whether sigma has no kink over a part, some of which may lie beyond the triangle's border: lines
// do not begin to miss a sphere there, and no height comes to its limit. False does not say that it
// has one.
bool sphere_is_smooth(const Patch& patch, const Part& part);

// Ranges of sigma and of its derivatives along u and v. Nothing where a height may be at its limit
// or its line may miss the sphere, and at a vertex, about which the derivatives of the curvature
// turn.
struct SigmaRanges {
  Interval s;
  Interval u;
  Interval v;
};
std::optional<SigmaRanges> sphere_derivative_ranges(const Patch& patch, const Part& part,
                                                    const PartCorners& corners);

}  // namespace trisect
