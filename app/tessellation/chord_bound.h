// How far the curved surface can be from a flat triangle with its corners on it.
#pragma once

#include "app/surface/patch_range.h"
#include "app/surface/surface_choice.h"

namespace trisect {

// A bound of |S(w) - L(w)| over the piece of a patch between the points of these weights, where L
// is the linear function that agrees with S at them: no point of the piece is farther than that
// from the flat triangle, and no point of the triangle from the piece. A length, proven for the
// exact S of the baked numbers, roundings of its own included: a caller adds how far the corners
// that it has are off S. It falls with the square of the piece's size where S is smooth. For the
// normal shell. Pure.
//
// phong:  S - L is a cubic that vanishes at the corners. Of its other Bezier points e_iij and e_ijj
//         belong to an edge and e_012 to the middle:
//         |S - L| <= sum over edges of 3 w_i w_j (w_i + w_j) max(|e_iij|, |e_ijj|)
//                    + 6 w_0 w_1 w_2 |e_012|.
// sphere: sphere_chord_bound().
double chord_bound(const SurfaceChoice& choice, const Patch& patch, const CornerWeights& piece);

}  // namespace trisect
