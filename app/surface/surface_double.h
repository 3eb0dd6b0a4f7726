// The shaders' surface mathematics as C++ in double precision: the same source text, compiled a
// second time.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "app/base/interval.h"
#include "shaders/gamma.h"

namespace trisect::in_double {

using namespace glm;  // NOLINT(google-build-using-namespace): GLSL's own function names
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;

#include "shaders/shared.h"

// What the ranges of shaders/range.glsl are here: the same operations, rounded outward.
using Range = Interval;
inline Range between(double lo, double hi) {
  return {lo, hi};
}
inline Range range_hull(const Range& a, const Range& b) {
  return trisect::hull(a, b);
}
inline Range range_intersection(const Range& a, const Range& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}
inline Range range_clamp(const Range& a, double lo, double hi) {
  return {std::clamp(a.lo, lo, hi), std::clamp(a.hi, lo, hi)};
}
inline double range_magnitude(const Range& a) {
  return std::max(std::abs(a.lo), std::abs(a.hi));
}
inline Range range_grown(const Range& a, double by) {
  return outward(a.lo - by, a.hi + by);
}
inline Range range_minus(const Range& a) {
  return -a;
}
inline Range range_sum(const Range& a, const Range& b) {
  return a + b;
}
inline Range range_scaled(const Range& a, double k) {
  return outward(a.lo * k, a.hi * k);
}
inline Range range_product(const Range& a, const Range& b) {
  return a * b;
}
inline Range range_quotient(const Range& a, const Range& b) {
  return divide_by_positive(a, b);
}
inline Range range_square(const Range& a) {
  return trisect::square(a);
}
inline Range range_root(const Range& a) {
  return trisect::root(a);
}

#define real double
#define GAMMA(n) GAMMA_DOUBLE(real, n)
#define FOR_PROOF(slack) (slack)
#define BY_PRECISION(single_value, double_value) double_value
#define EXACT
#define OUT(T) T&
#define INOUT(T) T&
// The functions are in an anonymous namespace: each translation unit has its own and need not call
// all of them.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wfloat-equal"
#include "shaders/shape.glsl"
namespace {
#include "shaders/sub_triangle.glsl"
// Control points are taken over sub-triangles.
#include "shaders/control_net.glsl"
// The polynomial of shaders/polar_angle.glsl has the accuracy of single precision only.
inline double polar_angle(double sine, double cosine) {
  return std::atan2(sine, cosine);
}
#include "shaders/linear.glsl"
// Rays are made of quotients.
#include "shaders/division.glsl"
#include "shaders/surface.glsl"
#include "shaders/thesis_field.glsl"
// The bisection needs the fields above.
#include "shaders/bisect.glsl"
// The ranges need the surface.
#include "shaders/sphere_range.glsl"
}  // namespace
#pragma GCC diagnostic pop
#undef real
#undef GAMMA
#undef FOR_PROOF
#undef BY_PRECISION
#undef EXACT
#undef OUT
#undef INOUT

}  // namespace trisect::in_double
