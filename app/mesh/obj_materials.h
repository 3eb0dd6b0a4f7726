// The colours of OBJ files' materials.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <set>
#include <string>

#include "app/mesh/polygon_model.h"

namespace trisect {

// By the materials' names, sRGB-encoded: those (Kd) that no texture (map_Kd) changes. libraries:
// what follows "mtllib" in lines: a file in the folder or below it, or several, one word each.
// Other files are not read. Adds the files that are read to the model's, and notes with the numbers
// of others and of files that are not there.
std::map<std::string, glm::vec3> material_colors(const std::set<std::string>& libraries,
                                                 const std::filesystem::path& folder,
                                                 PolygonModel& model);

}  // namespace trisect
