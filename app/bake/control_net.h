// The control points of cages, in double precision.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "app/surface/shared.h"
#include "app/surface/surface_double.h"

namespace trisect {

// A part of a patch, a sub-triangle of it: w = origin + size l.
struct SubTriangle {
  glm::dvec3 origin{0.0};
  double size = 1.0;
};

// The part with so much of its size around it on every side.
SubTriangle enlarged(const SubTriangle& part, double margin);

// The weights of its corners.
std::array<glm::dvec3, 3> corners_of(const SubTriangle& part);

// Bernstein coefficients of a quadratic in the weights of the whole triangle.
struct DisplacementQuadratic {
  glm::dvec3 corner{0.0};
  glm::dvec3 edge{0.0};  // 01, 12, 02

  [[nodiscard]] double blossom(const glm::dvec3& a, const glm::dvec3& b) const {
    return glm::dot(corner, a * b) + edge.x * (a.x * b.y + a.y * b.x) +
           edge.y * (a.y * b.z + a.z * b.y) + edge.z * (a.x * b.z + a.z * b.x);
  }
};

// What a patch is spanned by: its vertices and its shell's directions there.
struct Corners {
  std::array<glm::dvec3, 3> P;
  std::array<glm::dvec3, 3> D;
};

Corners corners_of(const in_double::Triangle& tri, uint shell);

// 1 for corner k of a triangle, 0 for the others.
glm::dvec3 corner_weights(int k);

// Control points b300, b030, b003, b210, b120, b021, b012, b102, b201, b111 of a cubic Bezier
// triangle; b_ijk belongs to w_0^i w_1^j w_2^k.
using ControlNet = std::array<glm::dvec3, 10>;

// The cubic Bezier triangle T + q D over a part.
ControlNet net_of(const Corners& corners, const SubTriangle& part, const DisplacementQuadratic& q);

}  // namespace trisect
