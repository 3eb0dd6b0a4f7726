// Proven ranges of the sphere surface over a sub-triangle of a patch: shaders/sphere_range.glsl in
// double precision, where every operation rounds outward, and conclusions from them.
//
// Each range holds every value in exact arithmetic on the baked numbers and on the directions D_i
// as patch_of has them, for all weights in the hull of the sub-triangle's. The functions have no
// state and may be called from several threads.
#pragma once

#include <array>
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

// Whether samples a third of a sub-triangle apart show how sigma changes over it, some of which may
// lie beyond the triangle's border: every height is proven to be where the line meets the sphere by
// the definition, which is analytic, or what it depends on is proven to change little. False is no
// proof of the contrary.
bool sphere_is_smooth(const Patch& patch, const CornerWeights& weights);

// Ranges of sigma and of its derivatives along u and v, in units of D. Nothing where a height may
// leave the definition, and at a vertex, about which the derivatives of the curvature turn.
struct SigmaRanges {
  Interval s;
  Interval u;
  Interval v;
};
std::optional<SigmaRanges> sphere_derivative_ranges(const Patch& patch,
                                                    const CornerWeights& weights,
                                                    const PatchCorners& corners);

// The same for all of the patch that is continuous, with what sigma changes by: where it has no
// derivative the ranges hold its generalised gradient (Clarke 1983), so that between two points of
// the sub-triangle, some of which may lie beyond the triangle's border, sigma changes by numbers of
// these times the changes of the weights (theorem 2.3.7). Nothing where they are not bounded.
std::optional<SigmaRanges> sphere_change_ranges(const Patch& patch, const CornerWeights& weights,
                                                const PatchCorners& corners);

// Ranges of the second derivatives of sigma along the patch's edges 01, 12 and 20, each edge once
// from end to end: along a direction of weights d (sum 0) it is - sum_{i<j} d_i d_j times that of
// edge ij. Nothing where a height may leave the definition. For weights within the patch.
std::optional<std::array<Interval, 3>> sphere_second_derivative_ranges(
    const Patch& patch, const CornerWeights& weights);

// A bound of |S(w) - L(w)| over the piece of a patch between the points of these weights, L linear
// and equal to S there. Roundings included; for the normal shell. The best of three bounds of
// |sigma - linear|:
//
// by second derivatives: sum_k l_k H_k(w_k - w) / 2 by Taylor's theorem, l the weights within the
//   piece, w_k its corners, H_k the quadratic form of the second derivatives somewhere on the way.
//   Of H's middle this is sum_{i<j} l_i l_j |H(w_i - w_j)| / 2 at most, and of the rest, by the
//   inequality of Cauchy and Schwarz, sum_{i<j} W_i W_j / 8 times half the width of the range along
//   edge ij, W_i the range of the patch's weight i in the piece;
// by derivatives: sigma changes between two points by an element of the hull of its generalised
//   gradients (Clarke 1983, theorem 2.3.7), so along a coordinate in which the piece has the width
//   W it differs by at most W / 2 times half the width of the derivative's range;
// by sigma's range.
//
// S - L = (sigma - linear) D - sum_{i<j} l_i l_j (sigma_i - sigma_j) (D_i - D_j).
double sphere_chord_bound(const Patch& patch, const CornerWeights& weights);

}  // namespace trisect
