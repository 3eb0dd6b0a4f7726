// The shaders' surface mathematics and robust solver as C++ in single precision: the same source
// text, compiled a second time.
#pragma once

#include <glm/glm.hpp>

#include "app/surface/shared.h"

namespace trisect::in_float {

using namespace glm;  // NOLINT(google-build-using-namespace): GLSL's own function names

#define real float
#define EXACT
#define OUT(T) T&
#define INOUT(T) T&
// Plain functions in a header: each translation unit has its own, and not all of them are called.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
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
#include "shaders/surface.glsl"
#include "shaders/thesis_field.glsl"
// The bisection needs the fields above.
#include "shaders/bisect.glsl"
// The bounds come before what uses them.
#include "shaders/subpatch_bounds.glsl"
// Then the ranges.
#include "shaders/sphere_range.glsl"
// The solver, then.
#include "shaders/robust.glsl"
}  // namespace
#pragma GCC diagnostic pop
#undef real
#undef EXACT
#undef OUT
#undef INOUT

}  // namespace trisect::in_float
