// Reading glTF 2.0, as JSON or binary (GLB).
#pragma once

#include <filesystem>
#include <string_view>

#include "app/mesh/polygon_model.h"

namespace trisect {

// The triangles of the scene that the file shows first, or of all nodes if it has no scene, or of
// all meshes if it has no nodes; in the file's units and axes. Nodes' transformations are applied,
// morph targets and skins are as the nodes are at rest. Quantised accessors
// (KHR_mesh_quantization), Draco (KHR_draco_mesh_compression) and EXT_meshopt_compression are read.
// Points and lines are left out, the notes say how many.
//
// bytes: of the file; path: of the file, beside which its buffers are looked for, in its folder and
// below. Throws InputError with the file's name if it is no such file, a buffer cannot be read, an
// index names nothing, or there are no triangles.
PolygonModel parse_gltf(std::string_view bytes, const std::filesystem::path& path);

}  // namespace trisect
