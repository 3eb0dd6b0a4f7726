// Meshes and rays that hard cases are made of.
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

// Normals need not be of unit length.
Mesh patch(const Corners& positions, const Corners& normals);
// Of the corners (-1, 0, 0), (1, 0, 0), (0, 1, 0): a triangle that faces +z.
Mesh plain_patch(const Corners& normals);
// As plain_patch, every normal leaning by `degrees` away from the middle (toward it if negative).
Mesh leaning_patch(double degrees);
// All triangles of both; positions of `b` moved.
Mesh joined(const Mesh& a, const Mesh& b, const glm::dvec3& move);
// A regular icosahedron about 0 of radius 1, each triangle divided in 4 `levels` times; normals
// are the sphere's.
Mesh sphere(int levels = 0);
Mesh moved(Mesh mesh, double scale, const glm::dvec3& move);
// n by n squares of two triangles over [-1, 1]^2; z = a x^2 + b y^2 and its normals.
Mesh height_grid(int n, double a, double b);

// A direction from anywhere.
glm::dvec3 any_direction(std::mt19937_64& random);
// At right angles to `axis`.
glm::dvec3 across(const glm::dvec3& axis, std::mt19937_64& random);

// A point of a curved triangle: any one, or that of given weights.
struct SurfacePoint {
  uint32_t triangle;
  glm::dvec3 weights;
  glm::dvec3 position;
  glm::dvec3 normal;  // of unit length, or NaN where there is none
};
SurfacePoint point_at(const BakedScene& scene, uint32_t triangle, const glm::dvec3& weights);
SurfacePoint any_point(const BakedScene& scene, std::mt19937_64& random);

// A ray through `point` (relative to the scene's origin) that begins outside the scene. Its anchor
// is the point of it that is nearest to the scene's origin.
CastRay ray_through(const BakedScene& scene, const glm::dvec3& point, const glm::dvec3& direction);
// The same, but its anchor is `point` itself, so that it passes it to the last bit.
CastRay ray_exactly_through(const BakedScene& scene, const glm::dvec3& point,
                            const glm::dvec3& direction);

// `count` rays at points of the surface from all around; every fourth leans to graze it.
std::vector<CastRay> rays_at_surface(const BakedScene& scene, std::mt19937_64& random, int count);

}  // namespace trisect::stress
