// The colours of OBJ files' materials.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace trisect {

// By the materials' names, sRGB-encoded: those (Kd) that no texture (map_Kd) changes. libraries: as
// "mtllib" lines name them, in the folder or below it; what is named outside of it is not read.
// Adds a note for each that is not there or cannot be read.
std::map<std::string, glm::vec3> material_colors(const std::vector<std::string>& libraries,
                                                 const std::filesystem::path& folder,
                                                 std::vector<std::string>& notes);

}  // namespace trisect
