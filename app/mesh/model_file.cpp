#include "app/mesh/model_file.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <utility>

#include "app/base/error.h"
#include "app/base/folder_of.h"
#include "app/base/memory.h"
#include "app/base/word_at.h"
#include "app/mesh/assimp_file.h"
#include "app/mesh/file_bytes.h"
#include "app/mesh/gltf_file.h"
#include "app/mesh/obj_file.h"

namespace trisect {
namespace {

// The ending of a name in small letters, without that of a compressed file.
std::string ending_of(std::filesystem::path path) {
  const auto ending = [&] {
    std::string text = path.extension().string();
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  if (ending() == ".gz") path.replace_extension();
  return ending();
}

// A binary STL is 80 bytes of any text, the number of its facets, and 50 bytes for each.
bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < 84) return false;
  const uint32_t facets = word_at(bytes, 80);
  return facets > 0 && bytes.size() == 84 + std::size_t{facets} * 50;
}

bool is_text_stl(std::string_view bytes) {
  const std::string_view start = bytes.substr(0, 4096);
  return start.starts_with("solid") && start.find("facet") != std::string_view::npos;
}

bool is_json(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '{';
}

}  // namespace

bool is_model_name(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".obj" || format_of({}, path) != ModelFormat::obj;
}

ModelFormat format_of(std::string_view bytes, const std::filesystem::path& path) {
  if (bytes.starts_with("glTF") || is_json(bytes)) return ModelFormat::gltf;
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return ModelFormat::ply;
  if (bytes.starts_with("Kaydara FBX Binary") || bytes.starts_with("; FBX")) {
    return ModelFormat::fbx;
  }
  if (is_binary_stl(bytes) || is_text_stl(bytes)) return ModelFormat::stl;
  const std::string ending = ending_of(path);
  if (ending == ".gltf" || ending == ".glb") return ModelFormat::gltf;
  if (ending == ".ply") return ModelFormat::ply;
  if (ending == ".stl") return ModelFormat::stl;
  if (ending == ".fbx") return ModelFormat::fbx;
  return ModelFormat::obj;
}

const char* format_name(ModelFormat format) {
  switch (format) {
    case ModelFormat::gltf:
      return "glTF";
    case ModelFormat::ply:
      return "PLY";
    case ModelFormat::stl:
      return "STL";
    case ModelFormat::fbx:
      return "FBX";
    case ModelFormat::obj:
      break;
  }
  return "OBJ";
}

PolygonModel read_model(const std::filesystem::path& path, ModelFormat* format) {
  std::error_code unknown;
  const auto size = static_cast<double>(std::filesystem::file_size(path, unknown));
  // What it took of files of 450,000 triangles (docs/formats.md).
  if (!unknown) expect_memory(6.0 * size, "reading " + path.string());
  std::string bytes = read_bytes(path);
  if (bytes.empty()) throw InputError(path.string() + ": is empty.");
  const ModelFormat found = format_of(bytes, path);
  if (format != nullptr) *format = found;
  switch (found) {
    case ModelFormat::gltf:
      return parse_gltf(bytes, path);
    case ModelFormat::ply:
      return parse_by_assimp(std::move(bytes), "ply", path.string());
    case ModelFormat::stl:
      return parse_by_assimp(std::move(bytes), "stl", path.string());
    case ModelFormat::fbx:
      return parse_by_assimp(std::move(bytes), "fbx", path.string());
    case ModelFormat::obj:
      break;
  }
  return parse_obj(bytes, path.string(), folder_of(path));
}

}  // namespace trisect
