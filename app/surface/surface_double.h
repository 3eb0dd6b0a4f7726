// The shaders' surface mathematics as C++ in double precision: the same source text, compiled a
// second time.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace trisect::in_double {

using namespace glm;  // NOLINT(google-build-using-namespace): GLSL's own function names
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;

#include "shaders/shared.h"

#define real double
#define EXACT
#define OUT(T) T&
#define INOUT(T) T&
// Plain functions in a header: each translation unit has its own, and not all of them are called.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wfloat-equal"
#include "shaders/shape.glsl"
namespace {
#include "shaders/sub_triangle.glsl"
// Control points are taken over sub-triangles.
#include "shaders/control_net.glsl"
// shaders/polar_angle.glsl is of single precision.
inline double polar_angle(double sine, double cosine) {
  return std::atan2(sine, cosine);
}
#include "shaders/linear.glsl"
#include "shaders/surface.glsl"
#include "shaders/thesis_field.glsl"
// The march needs the fields above.
#include "shaders/bisect.glsl"
}  // namespace
#pragma GCC diagnostic pop
#undef real
#undef EXACT
#undef OUT
#undef INOUT

}  // namespace trisect::in_double
