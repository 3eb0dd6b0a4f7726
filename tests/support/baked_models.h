// Models with their baked subpatches, for tests of their bounds, and what the bounds say of them.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "app/bake/bake.h"
#include "app/surface/control_net.h"
#include "app/surface/patch_range.h"
#include "app/surface/surface_double.h"

namespace trisect::test {

struct BakedModel {
  const char* name;
  SurfaceChoice choice;
};

inline constexpr std::array kBakedModels{
    BakedModel{"sphere-20", {SURFACE_PHONG, 0.65, SHELL_NORMAL}},
    BakedModel{"saddle", {SURFACE_PHONG, 1.0, SHELL_NORMAL}},
    BakedModel{"teapot", {SURFACE_PHONG, 0.65, SHELL_NORMAL}},
    BakedModel{"relief", {SURFACE_PHONG, 0.65, SHELL_HEIGHT}},
    BakedModel{"sphere-80", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}}};

// Of an asset or, "wild", of patches with steep normals.
BakedScene baked(const BakedModel& model);

// Weights of the triangle, of weights l of a subpatch.
glm::dvec3 weights_of(const SubpatchBounds& bounds, const glm::dvec3& l);

in_double::SubTriangle sub_triangle_of(const SubpatchBounds& bounds);

DisplacementQuadratic quadratic_of(const SubpatchBounds& bounds);

// The control points of a subpatch with its overlap.
std::array<glm::dvec3, 10> control_points_of(const BakedScene& scene, const SubpatchBounds& bounds);

// How far S and its tangents are from those of T + q D at weights w.
struct QuadraticErrors {
  double position;
  double tangents;
};
QuadraticErrors errors_of(const DisplacementQuadratic& q, const in_double::Shape& shape,
                          const in_double::Triangle& tri, const Patch& corners,
                          const glm::dvec3& w);

}  // namespace trisect::test
