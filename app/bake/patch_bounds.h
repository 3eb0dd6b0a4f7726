// A ball that contains a displaced triangle, proven for each surface.
#pragma once

#include "app/bake/enclosing_ball.h"
#include "app/base/rounding.h"
#include "app/surface/shared.h"
#include "app/surface/surface_choice.h"

namespace trisect {

// Contains S(w) for all w of the triangle, for the surface that the baked numbers of `tri` define
// (all but Domain must be set). Proven for any finite alpha and any unit normals; the radius is
// enlarged by kBoundSlack for rounding. Pure. It is the ball of enclosing_ball() around these:
//
// flat: the vertices.
//
// phong, normal shell: the control points of a cubic Bezier triangle, whose hull contains it.
//
// phong, height shell: sigma D is the projection of alpha K, the offset of Phong Tessellation, on
// the line along D. So it ends on the sphere with the diameter alpha K (Thales), whatever D is, and
// S(w) lies in the ball about T + alpha K / 2 of radius |alpha K| / 2. K is quadratic,
// sum_{i<j} w_i w_j V_ij with V_ij = (E_ij.N_j) N_j - (E_ij.N_i) N_i, so each of these balls is a
// convex combination of six: the vertices and, for each edge, the ball about
// (P_i + P_j) / 2 + alpha V_ij / 4 of radius |alpha V_ij| / 4. A ball that contains the six
// contains the patch.
//
// sphere: over a sub-triangle with corners T_k and directions D_k sigma lies in an interval
// [lo, hi], by interval arithmetic on the closed form, so S lies in the hull of the points
// T_k + lo D_k and T_k + hi D_k. The triangle is divided, up to three times, until the ball is
// within 10% of the flat triangle's. Where that gives nothing better, for example where D is
// undefined or turns over (a normal 90 degrees or more off the face), the flat triangle's ball
// enlarged by the longest edge remains, as no point is displaced farther.
Ball bound_patch(const SurfaceChoice& choice, const Triangle& tri);

// Relative to the radius plus the distance from the origin: the roundings to single precision of
// the baked numbers and of a point on the surface, at least gamma(16). A kernel's own test of a ray
// against the ball allows for its roundings itself. The bisection's chord is the ball's: another
// value would let it begin elsewhere.
constexpr double kBoundSlack = 1e-6;
static_assert(kBoundSlack >= gamma_single(16));

}  // namespace trisect
