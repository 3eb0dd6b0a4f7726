// Files of flat triangles: OBJ, PLY, STL and GLB.
#pragma once

#include <filesystem>
#include <optional>

#include "app/base/atomic_file.h"
#include "app/tessellation/flat_mesh.h"

namespace trisect {

enum class MeshFormat { obj, ply, stl, glb };

// By the ending of a file's name, in any case; nothing for any other.
std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path);

// The farthest that a file's numbers can move a vertex: PLY, STL and GLB have single precision, OBJ
// ten digits.
double file_rounding(const Mesh& mesh, const BakedScene& scene, MeshFormat format);

// Writes positions and normals in the model's units and axes. OBJ: vertices at the same place are
// one, with several normals. PLY: binary, little-endian. STL: binary, which has normals of facets
// only and no common vertices. GLB: glTF 2.0 in one file. The caller commits the file. Throws
// InputError, naming the target, if it cannot be written.
void write_mesh(const FlatMesh& mesh, MeshFormat format, const AtomicFile& file);

}  // namespace trisect
