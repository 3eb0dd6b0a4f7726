// A fine model with fewer triangles.
#pragma once

#include <cstddef>
#include <string>

#include "app/mesh/mesh.h"
#include "app/tessellation/flat_mesh.h"

namespace trisect::bench {

// The mesh decimated by meshoptimizer to `count` triangles, or as few as it can: vertices of the
// mesh with their normals, edges collapsed by the quadric error metric (Garland and Heckbert 1997).
// Throws InputError, with `name` in its message, if no triangle is left.
Mesh decimated(const FlatMesh& mesh, std::size_t count, const std::string& name);

}  // namespace trisect::bench
