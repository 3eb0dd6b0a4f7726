// The shaders' surface mathematics with the 64-bit significand of x86's long double: the same
// source text as in app/surface/surface_double.h, with eleven more bits. It stands for exact
// arithmetic where results in double precision are judged to the last bit.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "app/surface/surface_double.h"

namespace trisect::in_long_double {

using namespace glm;  // NOLINT(google-build-using-namespace): GLSL's own function names
using extended = long double;
using vec2 = glm::vec<2, extended>;
using vec3 = glm::vec<3, extended>;
using vec4 = glm::vec<4, extended>;

#include "shaders/shared.h"

#define real extended
#define EXACT
#define OUT(T) T&
#define INOUT(T) T&
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wfloat-equal"
#include "shaders/shape.glsl"
namespace {
inline extended polar_angle(extended sine, extended cosine) {
  return std::atan2(sine, cosine);
}
#include "shaders/linear.glsl"
#include "shaders/surface.glsl"
}  // namespace
#pragma GCC diagnostic pop
#undef real
#undef EXACT
#undef OUT
#undef INOUT

// Exact: no number changes.
inline Triangle widened(const in_double::Triangle& tri) {
  Triangle wide{};
  for (int i = 0; i < 3; ++i) {
    wide.Position[i] = vec4(tri.Position[i]);
    wide.Normal[i] = vec4(tri.Normal[i]);
    wide.VertexData[i] = vec4(tri.VertexData[i]);
  }
  wide.TriNormal = vec4(tri.TriNormal);
  wide.NormDot = vec4(tri.NormDot);
  wide.Domain = vec4(tri.Domain);
  return wide;
}

}  // namespace trisect::in_long_double
