// Reading PLY, STL and FBX files by Assimp.
#pragma once

#include <string>

#include "app/mesh/polygon_model.h"

namespace trisect {

// The polygons of all meshes of a file, with the transformations of their nodes, in the file's
// units and axes. format: "ply", "stl" or "fbx". STL has normals of facets only: they are ignored,
// and smooth ones are made. Points and lines are left out, the notes say how many. `name` stands
// for the file in messages. Throws InputError if it cannot be read or has no faces.
PolygonModel parse_by_assimp(std::string bytes, const std::string& format, const std::string& name);

}  // namespace trisect
