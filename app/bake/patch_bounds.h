// A ball that contains a displaced triangle, proven, for each surface.
#pragma once

#include "app/bake/enclosing_ball.h"
#include "app/surface/shared.h"
#include "app/surface/surface_choice.h"

namespace trisect {

// The whole of S(w), w over the triangle, for the surface that the baked numbers of `tri` define
// (all but Domain must be set). Holds in exact arithmetic for any finite alpha and any normals; the
// radius has kBoundSlack added for the kernels' rounding.
//
// flat:   the vertices.
// phong, normal shell: the control points of a cubic Bezier triangle, whose hull contains it.
// phong, height shell: alpha K, the offset of Phong Tessellation, is projected on the line along D,
// so the displacement
//         ends on the sphere with diameter alpha K (Thales), whatever D is: S(w) lies in the ball
//         about T + alpha K / 2 of radius |alpha K| / 2. K is quadratic, sum_{i<j} w_i w_j V_ij
//         with V_ij = (E_ij.N_j) N_j - (E_ij.N_i) N_i, so these balls are convex combinations of
//         six: the vertices and, for each edge, the ball about (P_i + P_j) / 2 + alpha V_ij / 4 of
//         radius |alpha V_ij| / 4. What contains the six contains the patch.
// sphere: over a part of the triangle with corners T_k, D_k, sigma lies in an interval [lo, hi]
// (interval
//         arithmetic on the closed form), so S lies in the hull of T_k + lo D_k and T_k + hi D_k.
//         The triangle is divided until that is tight. Where D is undefined or turns over (a normal
//         90 degrees or more off the face), the displacement's limit, the longest edge, bounds it.
Ball bound_patch(const SurfaceChoice& choice, const Triangle& tri);

// Relative to the radius plus the distance from the origin: some ten roundings to single precision,
// those of the baked numbers and of a point on the surface. How far a kernel's own test of a ray
// against the ball is off is the kernel's affair.
constexpr double kBoundSlack = 1e-6;

}  // namespace trisect
