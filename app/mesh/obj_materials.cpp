#include "app/mesh/obj_materials.h"

#include <fmt/format.h>

#include <set>
#include <sstream>

#include "app/base/error.h"
#include "app/mesh/file_bytes.h"

namespace trisect {
namespace {

// Nothing but a file in the folder or below it.
bool is_below(const std::filesystem::path& name) {
  const std::filesystem::path normal = name.lexically_normal();
  return !normal.empty() && !normal.is_absolute() && *normal.begin() != "..";
}

// tinyobjloader takes a material without Kd for a black one: so read here what there is of them.
void read_materials(const std::string& text, std::map<std::string, glm::vec3>& colors) {
  std::istringstream lines(text);
  std::set<std::string> textured;
  std::string name;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "newmtl") {
      std::getline(words >> std::ws, name);
      name.erase(name.find_last_not_of(" \t\r") + 1);
    } else if (key == "Kd") {
      glm::vec3 color;
      if (words >> color.x >> color.y >> color.z) colors[name] = color;
    } else if (key == "map_Kd") {
      textured.insert(name);
    }
  }
  for (const std::string& material : textured) colors.erase(material);
}

}  // namespace

std::map<std::string, glm::vec3> material_colors(const std::vector<std::string>& libraries,
                                                 const std::filesystem::path& folder,
                                                 std::vector<std::string>& notes) {
  std::map<std::string, glm::vec3> colors;
  for (const std::string& library : libraries) {
    if (!is_below(library)) {
      notes.push_back("a material file outside the model's folder not read");
      continue;
    }
    std::string text;
    try {
      text = read_bytes(folder / library);
    } catch (const InputError&) {
      notes.push_back("a material file that is not there or cannot be read left out");
      continue;
    }
    read_materials(text, colors);
  }
  return colors;
}

}  // namespace trisect
