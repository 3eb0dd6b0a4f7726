// What renderers do about the shadow terminator: where a flat triangle with smooth normals turns
// from the light, its own shadow falls in steps. Pure functions, in single precision as there.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace trisect::bench {

// A flat triangle with the unit normals of its vertices, on the side that is seen, and a point of
// it.
struct SmoothPoint {
  std::array<glm::vec3, 3> vertices;
  std::array<glm::vec3, 3> normals;
  glm::vec3 weights;  // of the vertices, at the point

  [[nodiscard]] glm::vec3 position() const;
  // Interpolated, of unit length.
  [[nodiscard]] glm::vec3 normal() const;
};

// Where Hanika begins the shadow ray ("Hacking the shadow terminator", Ray Tracing Gems II, 2021,
// chapter 4): the interpolation of the point's projections onto the vertices' tangent planes, of
// those above it.
glm::vec3 on_tangent_planes(const SmoothPoint& point);

// Where Cycles begins it ("Geometry Offset" in the manual of Blender 2.90 and later), by the
// smallest height along the interpolated normal at which the vertices' tangent planes lie, each
// moved up to the highest of the vertices; by half of a paraboloid that follows the normals, if
// that is more. All of it where the triangle turns away or light and normal make an angle near 90
// degrees, none where both the normal and the triangle face the light by a cosine of 0.1 and more.
// face: the triangle's normal, on that side. light: of unit length.
glm::vec3 under_envelope(const SmoothPoint& point, const glm::vec3& face, const glm::vec3& light);

// By which Chiang, Li and Burley dim the light ("Taming the shadow terminator", 2019): -G^3 + G^2 +
// G with G = min(1, g.l / ((n.l) (n.g))), 0 where the triangle faces away. face as above; normal,
// light: of unit length, normal.light > 0.
float softening(const glm::vec3& face, const glm::vec3& normal, const glm::vec3& light);

}  // namespace trisect::bench
