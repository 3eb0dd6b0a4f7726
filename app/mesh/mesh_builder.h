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

// Triangulates every polygon, leaves out triangles of no area, and gives every corner a unit
// normal: the file's, or, where it has none or one of length zero, the angle-weighted mean of the
// faces around the welded vertex (Thuermer & Wuethrich 1998). crease_degrees: if given, the file's
// normals are ignored, and faces whose planes differ by more than this angle do not share theirs.
// Throws InputError, naming `name`, if no triangle is left.
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
