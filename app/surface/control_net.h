// The control points of shaders/control_net.glsl in double precision.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "app/surface/patch_range.h"

namespace trisect {

// A quadratic q of the patch's weights, by its Bernstein coefficients over the whole triangle.
struct DisplacementQuadratic {
  glm::dvec3 corner{0.0};  // 00, 11, 22
  glm::dvec3 edge{0.0};    // 01, 12, 02

  // The polar form: blossom(w, w) is q at w, and 2 blossom(w, d) its derivative along a direction d
  // (weights that add up to 0).
  [[nodiscard]] double blossom(const glm::dvec3& a, const glm::dvec3& b) const;
};

// The ten control points b300, b030, b003, b210, b120, b021, b012, b102, b201, b111 of the cubic
// Bezier triangle T + q D over a sub-triangle, which may reach beyond the patch. Pure.
std::array<glm::dvec3, 10> control_points(const Patch& patch, const DisplacementQuadratic& q,
                                          const in_double::SubTriangle& sub_triangle);

// The control vectors of its derivatives by the weights 1 and 2 within the sub-triangle, divided by
// 3: at each point its S_u and S_v are the same convex combination of the u and of the v. Pure.
struct TangentNet {
  std::array<glm::dvec3, 6> u;
  std::array<glm::dvec3, 6> v;
};
TangentNet tangent_net(const Patch& patch, const DisplacementQuadratic& q,
                       const in_double::SubTriangle& sub_triangle);

// sigma of Phong Tessellation in the normal shell: alpha sum_{i<j} w_i w_j (P_j - P_i).(N_j - N_i).
DisplacementQuadratic phong_quadratic(const Patch& patch, double alpha);

}  // namespace trisect
