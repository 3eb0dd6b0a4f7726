// From a file's polygons to a mesh: triangulation, normals, and a report of what was found.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

#include "app/mesh/mesh.h"
#include "app/mesh/polygon_model.h"

namespace trisect {

struct BuiltMesh {
  Mesh mesh;
  MeshReport report;
};

// How a mesh is made of polygons.
struct MeshOptions {
  // If given, the model's normals are ignored, and a corner's mean leaves out faces whose normals
  // differ from its own face's by more than this angle.
  std::optional<double> crease_degrees;
  // Vertices no farther apart than this, in the model's units, count as one, at the place of the
  // first of them.
  double weld = 0.0;
  // Triangles are turned around so that neighbours have the same winding: outward where the surface
  // is closed, else as most of them had it.
  bool repair = false;

  bool operator==(const MeshOptions&) const = default;
};

// Triangulates every polygon, leaves out triangles without area, and gives every corner a unit
// normal: the model's, or, where the model has none or one of length zero, the mean of the face
// normals around the vertex, weighted by the faces' angles there (Thuermer & Wuethrich 1998,
// "Computing vertex normals from polygonal facets"). Vertices at the same position count as one. Of
// the faces around a vertex those count that are connected with the corner's own by edges of two
// triangles of the same smoothing group: where two solids touch in a point each has its own
// normals. Pure and deterministic. Throws InputError, with `name` in its message, if no triangle is
// left.
BuiltMesh build_mesh(PolygonModel model, const std::string& name, const MeshOptions& options = {});

// The same from arrays, as other programs hold a model: triangle t has the positions
// triangles[3 t] to triangles[3 t + 2], counter-clockwise seen from the front. normals: one for
// each position, of any length, or none at all. Throws InputError if a number is not finite, an
// index names no position, or the sizes do not go together.
BuiltMesh build_mesh(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> normals,
                     std::span<const uint32_t> triangles, const MeshOptions& options = {});

// One line for a person: "teapot.obj: 304 triangles, 170 vertices, normals from the file, ...".
std::string describe(const MeshReport& report);

}  // namespace trisect
