// The shaders' surface mathematics and robust solver as C++ in single precision: the same source
// text, compiled a second time.
#pragma once

#include <glm/glm.hpp>

#include "app/surface/shared.h"
#include "shaders/gamma.h"

namespace trisect::in_float {

using namespace glm;  // NOLINT(google-build-using-namespace): GLSL's own function names

#define real float
#define GAMMA(n) GAMMA_SINGLE(real, n)
#define FOR_PROOF(slack) real(0.0)
#define BY_PRECISION(single_value, double_value) single_value
#define EXACT
#define OUT(T) T&
#define INOUT(T) T&
// The functions are in an anonymous namespace: each translation unit has its own and need not call
// all of them.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
// FOR_PROOF leaves parameters without a use.
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "shaders/shape.glsl"
#include "shaders/solver_types.glsl"
namespace {
#include "shaders/sub_triangle.glsl"
// Control points are taken over sub-triangles.
#include "shaders/control_net.glsl"
// The angle needs nothing.
#include "shaders/polar_angle.glsl"
// Vectors need the angle.
#include "shaders/linear.glsl"
// Rays are made of quotients.
#include "shaders/division.glsl"
#include "shaders/surface.glsl"
#include "shaders/thesis_field.glsl"
// The bisection needs the fields above.
#include "shaders/bisect.glsl"
// The ranges' own type comes before the ranges.
#include "shaders/range.glsl"
// The ranges of the sphere surface come before the bounds made of them.
#include "shaders/sphere_range.glsl"
// The bounds by a quadratic come before those of nonsmooth subpatches.
#include "shaders/subpatch_bounds.glsl"
// Both kinds of bounds come before the solver.
#include "shaders/nonsmooth_fit.glsl"
// The solver comes last.
#include "shaders/robust.glsl"
}  // namespace
#pragma GCC diagnostic pop
#undef real
#undef GAMMA
#undef FOR_PROOF
#undef BY_PRECISION
#undef EXACT
#undef OUT
#undef INOUT

}  // namespace trisect::in_float
