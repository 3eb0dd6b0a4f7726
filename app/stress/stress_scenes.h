// The meshes and rays from which the hard cases are made. All functions are deterministic: a
// generator in the same state gives the same rays.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "app/bake/bake.h"
#include "app/mesh/mesh.h"
#include "app/surface/shared.h"

namespace trisect::stress {

using Corners = std::array<glm::dvec3, 3>;

// One triangle. The normals need not be of unit length.
Mesh patch(const Corners& positions, const Corners& normals);
// The triangle with the corners (-1, 0, 0), (1, 0, 0), (0, 1, 0), which faces +z.
Mesh plain_patch(const Corners& normals);
// plain_patch() with every normal leaning by `degrees` away from the middle of the triangle, or
// toward it if negative.
Mesh leaning_patch(double degrees);
// All triangles of both meshes; `b` is moved by `move`.
Mesh joined(const Mesh& a, const Mesh& b, const glm::dvec3& move);
// A regular icosahedron of radius 1 about the origin, each triangle divided into 4 `levels` times,
// with all vertices on the unit sphere and the sphere's normals: 20 * 4^levels triangles.
Mesh sphere(int levels = 0);
// Every position times `scale`, plus `move`.
Mesh moved(Mesh mesh, double scale, const glm::dvec3& move);
// n by n squares of two triangles each over [-1, 1]^2, with the heights and normals of
// z = a x^2 + b y^2.
Mesh height_grid(int n, double a, double b);

// A unit vector, uniform over the sphere.
glm::dvec3 any_direction(std::mt19937_64& random);
// A unit vector at a right angle to `axis`.
glm::dvec3 across(const glm::dvec3& axis, std::mt19937_64& random);

// A point of the curved surface.
struct SurfacePoint {
  uint32_t triangle;
  glm::dvec3 weights;   // barycentric, of the triangle's vertices
  glm::dvec3 position;  // relative to the scene's origin
  glm::dvec3 normal;    // geometric, of unit length; NaN where the surface has no normal
};
SurfacePoint point_at(const BakedScene& scene, uint32_t triangle, const glm::dvec3& weights);
// Of a random triangle, at random weights.
SurfacePoint any_point(const BakedScene& scene, std::mt19937_64& random);

// A ray through `point` (relative to the scene's origin) that begins outside the scene. Its anchor
// is the ray's nearest point to the scene's origin, as the camera's rays have it. `direction` need
// not be of unit length.
CastRay ray_through(const BakedScene& scene, const glm::dvec3& point, const glm::dvec3& direction);
// The same, but `point`, rounded to single precision, is the anchor: the ray passes through it
// exactly.
CastRay ray_exactly_through(const BakedScene& scene, const glm::dvec3& point,
                            const glm::dvec3& direction);

// `count` rays from random directions at random points of the surface. Every fourth one grazes the
// surface, at an angle of about 0.02 radians at most.
std::vector<CastRay> rays_at_surface(const BakedScene& scene, std::mt19937_64& random, int count);

}  // namespace trisect::stress
