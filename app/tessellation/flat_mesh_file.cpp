#include "app/tessellation/flat_mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/rounding.h"

namespace trisect {
namespace {

using glm::dvec3;

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

template <typename Value>
void append(std::string& bytes, const Value& value) {
  std::array<char, sizeof(Value)> raw{};
  std::memcpy(raw.data(), &value, sizeof(Value));
  bytes.append(raw.data(), raw.size());
}

std::string obj_text(const FlatMesh& mesh) {
  const std::vector<uint32_t> first = first_at_same_place(mesh);
  std::vector<std::size_t> number(first.size());
  std::string text = "# made by trisect\n";
  const auto to = std::back_inserter(text);
  std::size_t places = 0;
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] == v) {
      number[v] = ++places;
      const dvec3& p = mesh.positions[v];
      fmt::format_to(to, "v {:.10g} {:.10g} {:.10g}\n", p.x, p.y, p.z);
    }
  }
  for (const glm::vec3& n : mesh.normals) {
    fmt::format_to(to, "vn {:.7g} {:.7g} {:.7g}\n", n.x, n.y, n.z);
  }
  for (const glm::uvec3& t : mesh.triangles) {
    fmt::format_to(to, "f {}//{} {}//{} {}//{}\n", number[first[t.x]], t.x + 1, number[first[t.y]],
                   t.y + 1, number[first[t.z]], t.z + 1);
  }
  return text;
}

std::string ply_bytes(const FlatMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment made by trisect\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  bytes.reserve(bytes.size() + mesh.positions.size() * 24 + mesh.triangles.size() * 13);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    append(bytes, glm::vec3(mesh.positions[v]));
    append(bytes, mesh.normals[v]);
  }
  for (const glm::uvec3& t : mesh.triangles) {
    bytes.push_back('\3');
    append(bytes, t);
  }
  return bytes;
}

std::string stl_bytes(const FlatMesh& mesh) {
  std::string bytes = "made by trisect";
  bytes.resize(80);
  bytes.reserve(84 + mesh.triangles.size() * 50);
  append(bytes, static_cast<uint32_t>(mesh.triangles.size()));
  for (const glm::uvec3& t : mesh.triangles) {
    const dvec3& a = mesh.positions[t.x];
    const dvec3 n = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    const double length = glm::length(n);
    append(bytes, glm::vec3(length > 0.0 ? n / length : dvec3(0.0)));
    for (int k = 0; k < 3; ++k) append(bytes, glm::vec3(mesh.positions[t[k]]));
    append(bytes, uint16_t{0});
  }
  return bytes;
}

std::string glb_bytes(const FlatMesh& mesh) {
  using nlohmann::ordered_json;
  const std::size_t vertices = mesh.positions.size();
  const std::size_t corners = mesh.triangles.size() * 3;
  glm::vec3 low(mesh.positions.front());
  glm::vec3 high = low;
  for (const dvec3& p : mesh.positions) {
    low = glm::min(low, glm::vec3(p));
    high = glm::max(high, glm::vec3(p));
  }
  const auto triple = [](const glm::vec3& v) { return ordered_json{v.x, v.y, v.z}; };
  constexpr int floats = 5126;
  constexpr int whole = 5125;
  constexpr int array = 34962;
  constexpr int indices = 34963;
  const std::size_t size = vertices * 24 + corners * 4;
  const ordered_json json{
      {"asset", {{"version", "2.0"}, {"generator", "trisect"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes",
       {{{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}}}}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", floats},
         {"count", vertices},
         {"type", "VEC3"},
         {"min", triple(low)},
         {"max", triple(high)}},
        {{"bufferView", 1}, {"componentType", floats}, {"count", vertices}, {"type", "VEC3"}},
        {{"bufferView", 2}, {"componentType", whole}, {"count", corners}, {"type", "SCALAR"}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", vertices * 12}, {"target", array}},
        {{"buffer", 0},
         {"byteOffset", vertices * 12},
         {"byteLength", vertices * 12},
         {"target", array}},
        {{"buffer", 0},
         {"byteOffset", vertices * 24},
         {"byteLength", corners * 4},
         {"target", indices}}}},
      {"buffers", {{{"byteLength", size}}}}};
  std::string head = json.dump();
  head.resize((head.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  bytes.reserve(28 + head.size() + size);
  append(bytes, uint32_t{2});
  append(bytes, static_cast<uint32_t>(28 + head.size() + size));
  append(bytes, static_cast<uint32_t>(head.size()));
  bytes += "JSON" + head;
  append(bytes, static_cast<uint32_t>(size));
  bytes += std::string_view("BIN\0", 4);
  for (const dvec3& p : mesh.positions) append(bytes, glm::vec3(p));
  for (const glm::vec3& n : mesh.normals) append(bytes, n);
  for (const glm::uvec3& t : mesh.triangles) append(bytes, t);
  return bytes;
}

}  // namespace

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".obj") return MeshFormat::obj;
  if (ending == ".ply") return MeshFormat::ply;
  if (ending == ".stl") return MeshFormat::stl;
  if (ending == ".glb") return MeshFormat::glb;
  return std::nullopt;
}

double file_rounding(const Mesh& mesh, const BakedScene& scene, MeshFormat format) {
  double farthest = 0.0;
  for (const dvec3& p : mesh.positions) farthest = std::max(farthest, glm::length(p));
  // Patches reach beyond their vertices. Ten digits are off by half a unit of the last.
  farthest += 2.0 * scene.radius;
  return farthest * (format == MeshFormat::obj ? 5e-10 : gamma_single(1));
}

void write_mesh(const FlatMesh& mesh, MeshFormat format, const AtomicFile& file) {
  file.write(format == MeshFormat::obj   ? obj_text(mesh)
             : format == MeshFormat::ply ? ply_bytes(mesh)
             : format == MeshFormat::stl ? stl_bytes(mesh)
                                         : glb_bytes(mesh));
}

}  // namespace trisect
