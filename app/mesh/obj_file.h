// Reading Wavefront OBJ files: tinyobjloader parses, this reader checks what it parses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace trisect {

// A corner of a polygon: zero-based indices into the arrays of ObjFile; no_normal where the file
// gives none.
struct ObjCorner {
  static constexpr uint32_t no_normal = 0xffffffffU;
  uint32_t position;
  uint32_t normal;
};

// The polygons of all groups and objects of a file, in file order.
struct ObjFile {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  // as in the file, not normalised
  std::vector<ObjCorner> corners;   // of all polygons, one polygon after the other
  std::vector<uint32_t> sizes;      // number of corners of each polygon, three or more
};

// What a model is called: "teapot" of "assets/teapot.obj".
std::string model_name(const std::filesystem::path& path);

// Reads a file. Throws InputError with the file's name and, where there is one, the line at fault,
// if the file cannot be read or has no faces, if a vertex or normal is not three finite numbers, or
// if a face has fewer than three corners or an index that names nothing.
ObjFile read_obj(const std::filesystem::path& path);

// The same for the text of a file; `name` stands for the file in messages.
ObjFile parse_obj(std::string_view file_text, const std::string& name);

}  // namespace trisect
