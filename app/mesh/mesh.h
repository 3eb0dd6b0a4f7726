// A triangle mesh with a normal at every corner, in double precision and in the units of its file.
// Plain data: nothing here is checked; build_mesh makes meshes that bake() takes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace trisect {

struct MeshTriangle {
  std::array<uint32_t, 3> vertex;  // into Mesh::positions, counter-clockwise seen from the front
  std::array<uint32_t, 3> normal;  // into Mesh::normals
};

struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  // unit length
  std::vector<MeshTriangle> triangles;
  // Of each triangle, sRGB-encoded from 0 to 1, negative where it has none; empty if none has one.
  std::vector<glm::vec3> colors;
};

// Normals that are no farther apart count as one: files often hold them in single precision or with
// seven digits, so that those of two triangles differ in the last one.
constexpr double kSameNormal = 1e-6;

// Where a mesh's normals come from.
enum class NormalSource {
  file,    // all from the file
  welded,  // none in the file: angle-weighted over welded vertices
  mixed,   // some corners have none in the file, or one of length zero, and got welded ones
};

// What build_mesh found in a model, for a person to look at.
struct MeshReport {
  std::size_t triangles = 0;
  std::size_t vertices = 0;  // distinct positions that triangles use
  NormalSource normals = NormalSource::file;
  std::size_t degenerate_dropped = 0;  // triangles without area, which were left out
  std::size_t hard_edges = 0;          // shared by two triangles whose normals differ along it
  std::size_t open_edges = 0;          // of one triangle only
  std::size_t non_manifold_edges = 0;  // of three triangles or more
  std::size_t flipped_edges = 0;       // of two triangles with opposite winding
  std::size_t turned = 0;              // triangles whose winding was repaired
  std::size_t colored = 0;             // triangles with a colour of their own
  std::size_t normals_behind = 0;      // corners whose normal points to the back of their triangle
  std::vector<std::string> notes;      // of PolygonModel
};

}  // namespace trisect
