// From a file's polygons to a mesh: triangulation, normals, and a report of what was found.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

#include "app/mesh/mesh.h"
#include "app/mesh/obj_file.h"

namespace trisect {

struct BuiltMesh {
  Mesh mesh;
  MeshReport report;
};

// Triangulates every polygon, leaves out triangles without area, and gives every corner a unit
// normal: the file's, or, where the file has none or one of length zero, the mean of the face
// normals around the vertex, weighted by the faces' angles there (Thuermer & Wuethrich 1998,
// "Computing vertex normals from polygonal facets"); vertices at the same position count as one.
// crease_degrees: if given, the file's normals are ignored, and a corner's mean leaves out faces
// whose normals differ from its own face's by more than this angle. Pure and deterministic. Throws
// InputError, with `name` in its message, if no triangle is left.
BuiltMesh build_mesh(const ObjFile& file, const std::string& name,
                     std::optional<double> crease_degrees = std::nullopt);

// The same from arrays, as other programs hold a model: triangle t has the positions
// triangles[3 t] to triangles[3 t + 2], counter-clockwise seen from the front. normals: one for
// each position, of any length, or none at all. Throws InputError if a number is not finite, an
// index names no position, or the sizes do not go together.
BuiltMesh build_mesh(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> normals,
                     std::span<const uint32_t> triangles,
                     std::optional<double> crease_degrees = std::nullopt);

// One line for a person: "teapot.obj: 304 triangles, 170 vertices, normals from the file, ...".
std::string describe(const MeshReport& report);

}  // namespace trisect
