#include "tests/support/baked_models.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "app/bake/subpatch_bounds.h"
#include "tests/support/scenes.h"

namespace trisect::test {

using glm::dvec3;

BakedScene baked(const BakedModel& model) {
  const bool wild = std::string(model.name) == "wild";
  return bake_with_subpatches(wild ? wild_patches(80) : load_asset(model.name), model.choice);
}

dvec3 weights_of(const SubpatchBounds& bounds, const dvec3& l) {
  return dvec3(bounds.sub_triangle) + l * static_cast<double>(bounds.sub_triangle.w);
}

in_double::SubTriangle sub_triangle_of(const SubpatchBounds& bounds) {
  return {dvec3(bounds.sub_triangle), double{bounds.sub_triangle.w}};
}

DisplacementQuadratic quadratic_of(const SubpatchBounds& bounds) {
  return {dvec3(glm::vec3(bounds.corner)), dvec3(glm::vec3(bounds.edge))};
}

std::array<dvec3, 10> control_points_of(const BakedScene& scene, const SubpatchBounds& bounds) {
  return control_points(patch_of(scene.choice.shell, scene.triangles[bounds.triangle]),
                        quadratic_of(bounds), in_double::with_overlap(sub_triangle_of(bounds)));
}

QuadraticErrors errors_of(const DisplacementQuadratic& q, const in_double::Shape& shape,
                          const in_double::Triangle& tri, const Patch& corners, const dvec3& w) {
  const in_double::Displacement sigma = in_double::displacement_and_derivatives(shape, tri, w);
  const dvec3 D = in_double::shell_direction(shape.shell, tri, w);
  const double e = sigma.s - q.blossom(w, w);
  const double off_u = sigma.u - 2.0 * q.blossom(w, {-1.0, 1.0, 0.0});
  const double off_v = sigma.v - 2.0 * q.blossom(w, {-1.0, 0.0, 1.0});
  return {std::abs(e) * glm::length(D),
          std::max(glm::length(D * off_u + (corners.D[1] - corners.D[0]) * e),
                   glm::length(D * off_v + (corners.D[2] - corners.D[0]) * e))};
}

}  // namespace trisect::test
