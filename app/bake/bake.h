// From a mesh to the triangle buffer of the kernels.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "app/mesh/mesh.h"
#include "app/surface/shared.h"
#include "app/surface/surface_choice.h"

namespace trisect {

// The mesh as the kernels see it. Positions are relative to `origin`: the centre of the vertices'
// bounding box, so that a model far from the world's origin keeps its digits in single precision,
// or what bake_about() was given.
struct BakedScene {
  SurfaceChoice choice;
  glm::dvec3 origin{0.0};
  std::vector<Triangle> triangles;         // in the order of the mesh
  std::vector<SubpatchBounds> subpatches;  // for the robust solver; empty if it is not used
  std::vector<BvhNode> bvh;                // over the subpatches; empty if none is needed
  bool has_colors = false;                 // some triangles have colours, in Position[].w
  glm::dvec3 middle{0.0};                  // of the bounding box, seen from `origin`
  double extent = 0.0;                     // half the diagonal of the bounding box
  double radius = 0.0;  // of the ball about `origin` that contains every triangle's Domain
};

// Bytes of the scene's buffers in a device's memory.
std::size_t device_bytes(const BakedScene& scene);

// How many triangles have no surface in the scene's shell (has_surface).
std::size_t count_without_surface(const BakedScene& scene);

// The triangles alone, without subpatches and bvh. Works on all cores; the result does not depend
// on their number. Throws InputError if the model is too large or too small for single precision,
// or if no triangle has a surface.
BakedScene bake(const Mesh& mesh, const SurfaceChoice& choice);

// Throws as bake() does if the model is too large or too small.
void expect_size(const Mesh& mesh);

// The same as bake() about an origin of the caller's in place of the middle of the mesh's bounding
// box: for rays that are given in the model's own coordinates. The mesh reaches 1e9 units from
// there at most.
BakedScene bake_about(const Mesh& mesh, const SurfaceChoice& choice, const glm::dvec3& origin);

// One triangle, from positions relative to the scene's origin and unit normals. Pure. Everything
// but the first two members follows from the positions and normals as rounded to single precision,
// so that it fits what the kernels see. For positions of up to 1e9 and any finite alpha of up to
// 1e3 all numbers are finite, and so are those that kernels get by dividing by NormDot and
// VertexData[i].z. The same holds for the scene's subpatches (bake_subpatches).
Triangle bake_triangle(const std::array<glm::dvec3, 3>& positions,
                       const std::array<glm::dvec3, 3>& normals, const SurfaceChoice& choice);

}  // namespace trisect
