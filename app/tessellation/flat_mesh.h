// A curved surface as flat triangles that share their vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/mesh/mesh.h"

namespace trisect {

// Each triangle has its corners on the surface of one patch. Where neighbouring patches have the
// same normals along an edge they have its vertices in common; across a hard edge they have
// vertices of their own, at the same places if the curves there are the same.
struct FlatMesh {
  std::vector<glm::dvec3> positions;  // in the model's units
  std::vector<glm::vec3> normals;     // unit length: the interpolated ones, which shading uses
  std::vector<glm::uvec3> triangles;  // counter-clockwise seen from the front
  std::vector<uint32_t> patches;      // of each triangle
  // Proven, in the model's units: no point of the surface is farther than that from the triangles,
  // and no point of the triangles from the surface (chord_bound).
  double bound = 0.0;
  // What of it is not the surface's bend: the farthest that a vertex is off the surface of one of
  // its patches. Positions of the mesh are as they were before bake() rounded them to single
  // precision, and neighbours whose normals differ a little have their vertices in common.
  double off = 0.0;
  // Triangles whose own bound is larger than divided_to() was asked for.
  std::size_t beyond_error = 0;
};

// The most triangles that are made; they take up to 320 bytes each meanwhile.
constexpr std::size_t kMostFlatTriangles = 16'000'000;

// Every patch as n x n triangles. scene: bake(mesh, ...) in the normal shell. Works on all cores;
// the result does not depend on their number. Nothing if progress said stop. Throws InputError
// beyond kMostFlatTriangles.
std::optional<FlatMesh> divided_evenly(const Mesh& mesh, const BakedScene& scene, uint32_t n,
                                       const FractionProgress& progress = {});

// As many triangles as it takes for a bound of `error`, in the model's units: edges are halved for
// both of their triangles, the most bent first, until every triangle's own bound is small enough.
// Where lines begin to miss a vertex's sphere no bound falls as fast as triangles shrink: those of
// less than a quarter of `error` are left as they are, and the mesh's bound is then larger; so is
// it where FlatMesh::off is more than three quarters of `error`. progress: an estimate. scene, the
// rest: as above.
std::optional<FlatMesh> divided_to(const Mesh& mesh, const BakedScene& scene, double error,
                                   const FractionProgress& progress = {});

// Of each vertex the first one at exactly the same place.
std::vector<uint32_t> first_at_same_place(const FlatMesh& mesh);

// Edges of one triangle only, where vertices at the same place count as one.
std::size_t count_open_edges(const FlatMesh& mesh);

}  // namespace trisect
