// Reading Wavefront OBJ files: tinyobjloader parses, this reader checks what it parses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace trisect {

// A corner of a polygon: zero-based, no_normal where the file gives none.
struct ObjCorner {
  static constexpr uint32_t no_normal = 0xffffffffU;
  uint32_t position;
  uint32_t normal;
};

// The polygons of all groups and objects of a file, in file order.
struct ObjFile {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  // as in the file, not normalised
  std::vector<ObjCorner> corners;   // of all polygons, one after the other
  std::vector<uint32_t> sizes;      // corners of each polygon, three or more
};

// What a model is called: "teapot" of "assets/teapot.obj".
std::string model_name(const std::filesystem::path& path);

// Throws InputError with the file's name and, where one is at fault, the line: a file that cannot
// be read, has no faces, a vertex or normal that is not three finite numbers, a face with fewer
// than three corners or with an index of nothing.
ObjFile read_obj(const std::filesystem::path& path);

// The same for a file's text; `name` stands for the file in messages.
ObjFile parse_obj(std::string_view file_text, const std::string& name);

}  // namespace trisect
