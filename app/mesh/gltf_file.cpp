#include "app/mesh/gltf_file.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/base/error.h"
#include "app/base/message.h"
#include "app/mesh/gltf_data.h"

namespace trisect {
namespace {

using glm::dmat3;
using glm::dmat4;
using glm::dvec3;
using gltf::Data;
using gltf::extension_of;
using gltf::Table;
using gltf::whole;
using gltf::whole_or;
using nlohmann::json;

// The specification's numbers.
enum Mode : uint32_t { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kStrip, kFan };

// The attributes and indices of a primitive, wherever they are.
class Primitive {
 public:
  Primitive(Data& data, const json& primitive) : data_(data), primitive_(primitive) {
    if (const json* packed = extension_of(primitive, "KHR_draco_mesh_compression")) unpack(*packed);
  }

  // Nothing if the primitive has no such attribute. columns: how many it must have, 0 for any.
  std::optional<Table> attribute(const std::string& name, std::size_t columns) {
    std::optional<Table> table;
    const auto packed = packed_.find(name);
    if (packed != packed_.end()) {
      table = std::move(packed->second);
    } else {
      const json& attributes = primitive_.at("attributes");
      const auto found = attributes.find(name);
      if (found == attributes.end()) return std::nullopt;
      table = data_.table(whole(*found));
    }
    if (columns != 0 && table->columns != columns) {
      data_.fail(fmt::format("{} has not {} components", name, columns));
    }
    return table;
  }

  // count: of the vertices.
  std::vector<uint32_t> indices(std::size_t count) {
    std::vector<uint32_t> indices = std::move(packed_indices_);
    if (indices.empty() && primitive_.contains("indices")) {
      const Table table = data_.table(whole(primitive_.at("indices")));
      if (table.columns != 1) data_.fail("the indices of a mesh are not single numbers");
      indices.reserve(table.numbers.size());
      // The specification has whole numbers there, but a file may have others.
      for (const double number : table.numbers) {
        const bool is_index = number >= 0.0 && number < 4294967295.0;
        indices.push_back(is_index ? static_cast<uint32_t>(number) : 0xffffffffU);
      }
    } else if (indices.empty()) {
      indices.resize(count);
      for (std::size_t i = 0; i < count; ++i) indices[i] = static_cast<uint32_t>(i);
    }
    for (const uint32_t index : indices) {
      if (index >= count) {
        data_.fail(fmt::format("a mesh of {} vertices names vertex {}", count, index));
      }
    }
    return indices;
  }

 private:
  void unpack(const json& packed) {
    const std::string_view bytes = data_.view(whole(packed.at("bufferView")));
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
      data_.fail(fmt::format("a mesh cannot be unpacked: {}", decoded.status().error_msg_string()));
    }
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    for (const auto& [name, id] : packed.at("attributes").items()) {
      const draco::PointAttribute* attribute =
          mesh->GetAttributeByUniqueId(static_cast<uint32_t>(whole(id)));
      if (attribute == nullptr) data_.fail("a packed mesh lacks " + name);
      const auto columns = static_cast<std::size_t>(attribute->num_components());
      Table table{columns, std::vector<double>(mesh->num_points() * columns),
                  std::numeric_limits<double>::infinity()};
      for (draco::PointIndex i(0); i < mesh->num_points(); ++i) {
        attribute->ConvertValue<double>(attribute->mapped_index(i), static_cast<int8_t>(columns),
                                        &table.numbers[i.value() * columns]);
      }
      packed_.emplace(name, std::move(table));
    }
    for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
      for (const draco::PointIndex& corner : mesh->face(f)) {
        packed_indices_.push_back(corner.value());
      }
    }
  }

  Data& data_;
  const json& primitive_;
  std::map<std::string, Table> packed_;
  std::vector<uint32_t> packed_indices_;
};

dmat4 local_matrix(const json& node) {
  const auto numbers = [&](const char* key, std::vector<double> otherwise) {
    const auto found = node.find(key);
    if (found == node.end()) return otherwise;
    auto given = found->get<std::vector<double>>();
    if (given.size() != otherwise.size()) {
      throw json::other_error::create(
          500, fmt::format("'{}' has {} numbers, not {}", key, given.size(), otherwise.size()),
          &node);
    }
    return given;
  };
  dmat4 matrix(1.0);
  if (node.contains("matrix")) {
    const std::vector<double> m = numbers("matrix", std::vector<double>(16));
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        matrix[column][row] =
            m[4 * static_cast<std::size_t>(column) + static_cast<std::size_t>(row)];
      }
    }
    return matrix;
  }
  const std::vector<double> t = numbers("translation", {0.0, 0.0, 0.0});
  const std::vector<double> r = numbers("rotation", {0.0, 0.0, 0.0, 1.0});
  const std::vector<double> s = numbers("scale", {1.0, 1.0, 1.0});
  const dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2])));
  for (int i = 0; i < 3; ++i) {
    matrix[i] = glm::dvec4(turn[i] * s[static_cast<std::size_t>(i)], 0.0);
  }
  matrix[3] = glm::dvec4(t[0], t[1], t[2], 1.0);
  return matrix;
}

// The largest length of M e for vectors e whose components are half a step at most.
double largest_rounding(const dmat3& m, double step) {
  if (step == 0.0) return 0.0;
  double largest = 0.0;
  for (const double y : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) {
      largest = std::max(largest, glm::length(m[0] + m[1] * y + m[2] * z));
    }
  }
  return 0.5 * step * largest;
}

// How far apart the unit vectors can be of two vectors that are `rounding` apart, one of this
// length.
double unit_rounding(double rounding, double length) {
  if (rounding == 0.0 || length == 0.0) return 0.0;
  return rounding < length ? 2.0 * std::sin(0.5 * std::asin(rounding / length)) : 2.0;
}

// Puts the meshes of a scene together.
class GltfScene {
 public:
  explicit GltfScene(Data& data) : data_(data) {}

  PolygonModel assemble() {
    const json& root = data_.root();
    const std::size_t nodes = root.contains("nodes") ? root.at("nodes").size() : 0;
    placed_.resize(nodes);
    for (const std::size_t node : shown_roots(nodes)) place(node, dmat4(1.0));
    // Now that all are placed: a skin's joints may come after its mesh.
    for (std::size_t node = 0; node < nodes; ++node) {
      if (placed_[node]) add_node(node);
    }
    if (nodes == 0 && root.contains("meshes")) {
      for (const json& mesh : root.at("meshes")) add_mesh(mesh, json::object(), dmat4(1.0));
    }
    close_groups(model_.sizes.size(), model_.groups);
    note_left_out(points_, "point primitive", model_);
    note_left_out(lines_, "line primitive", model_);
    note_left_out(without_positions_, "primitive without positions", model_);
    if (model_.sizes.empty()) data_.fail("the file has no faces" + notes_after_semicolon(model_));
    model_.files = data_.files();
    return std::move(model_);
  }

 private:
  [[nodiscard]] std::vector<std::size_t> shown_roots(std::size_t nodes) const {
    const json& root = data_.root();
    std::vector<std::size_t> roots;
    if (root.contains("scenes") && !root.at("scenes").empty()) {
      const json& scene = data_.element("scenes", whole_or(root, "scene", 0));
      if (scene.contains("nodes")) {
        for (const json& node : scene.at("nodes")) roots.push_back(whole(node));
      }
      return roots;
    }
    std::vector<bool> is_child(nodes, false);
    for (std::size_t node = 0; node < nodes; ++node) {
      for (const std::size_t child : children_of(node)) {
        if (child < nodes) is_child[child] = true;
      }
    }
    for (std::size_t node = 0; node < nodes; ++node) {
      if (!is_child[node]) roots.push_back(node);
    }
    return roots;
  }

  [[nodiscard]] std::vector<std::size_t> children_of(std::size_t node) const {
    std::vector<std::size_t> children;
    const json& object = data_.element("nodes", node);
    if (object.contains("children")) {
      for (const json& child : object.at("children")) children.push_back(whole(child));
    }
    return children;
  }

  // Without recursion, which a long chain of nodes could make too deep.
  void place(std::size_t first, const dmat4& parent) {
    std::vector<std::pair<std::size_t, dmat4>> waiting{{first, parent}};
    while (!waiting.empty()) {
      const auto [node, above] = waiting.back();
      waiting.pop_back();
      const dmat4 here = above * local_matrix(data_.element("nodes", node));
      if (placed_[node]) {
        data_.fail(fmt::format("node {} has several parents, or is its own", node));
      }
      placed_[node] = here;
      for (const std::size_t child : children_of(node)) waiting.emplace_back(child, here);
    }
  }

  void add_node(std::size_t number) {
    const json& node = data_.element("nodes", number);
    if (!node.contains("mesh")) return;
    const json& mesh = data_.element("meshes", whole(node.at("mesh")));
    add_mesh(mesh, node, *placed_[number]);
  }

  void add_mesh(const json& mesh, const json& node, const dmat4& matrix) {
    std::vector<double> weights;
    for (const json* holder : {&node, &mesh}) {
      if (weights.empty() && holder->contains("weights")) {
        weights = holder->at("weights").get<std::vector<double>>();
      }
    }
    add_group(mesh.value("name", std::string()), model_.sizes.size(), model_.groups);
    for (const json& primitive : mesh.at("primitives")) {
      add_primitive(primitive, weights, node, matrix);
    }
  }

  void add_primitive(const json& object, const std::vector<double>& weights, const json& node,
                     const dmat4& matrix) {
    const std::size_t mode = whole_or(object, "mode", kTriangles);
    if (mode > kFan) data_.fail(fmt::format("a mesh has the unknown mode {}", mode));
    if (mode < kTriangles) {
      ++(mode == kPoints ? points_ : lines_);
      return;
    }
    Primitive primitive(data_, object);
    std::optional<Table> positions = primitive.attribute("POSITION", 3);
    if (!positions) {
      ++without_positions_;
      return;
    }
    const std::size_t count = positions->rows();
    std::optional<Table> normals = primitive.attribute("NORMAL", 3);
    if (normals && normals->rows() != count) {
      data_.fail("a mesh has not as many normals as vertices");
    }
    std::optional<Table> colors = primitive.attribute("COLOR_0", 0);
    if (colors && (colors->rows() != count || colors->columns < 3)) {
      data_.fail("a mesh has not a colour for each vertex");
    }
    add_targets(object, weights, "POSITION", *positions);
    if (normals) add_targets(object, weights, "NORMAL", *normals);

    const std::size_t first = model_.positions.size();
    if (first + count > 0xfffffffeU) data_.fail("has too many vertices");
    const std::vector<dmat4> bones = bones_of(primitive, node, count);
    bool mirrored = glm::determinant(dmat3(matrix)) < 0.0;
    const dmat3 turn = matrix_for_normals(dmat3(matrix));
    make_room(count, model_.positions);
    if (normals) make_room(count, model_.normals);
    for (std::size_t i = 0; i < count; ++i) {
      const dmat4& at = bones.empty() ? matrix : bones[i];
      const dvec3 position(at * glm::dvec4(positions->vector(i), 1.0));
      if (i == 0 || !bones.empty()) {
        model_.position_rounding =
            std::max(model_.position_rounding, largest_rounding(dmat3(at), positions->step));
      }
      dvec3 normal(0.0);
      if (normals) {
        const dmat3 turn_here = bones.empty() ? turn : matrix_for_normals(dmat3(at));
        normal = turn_here * normals->vector(i);
        model_.normal_rounding = std::max(
            model_.normal_rounding,
            unit_rounding(largest_rounding(turn_here, normals->step), glm::length(normal)));
      }
      if (!add_vertex(position, normals ? &normal : nullptr, model_)) {
        data_.fail(fmt::format("vertex {} of a mesh is not three finite numbers", i));
      }
    }
    if (!bones.empty()) mirrored = glm::determinant(dmat3(bones[0])) < 0.0;
    const bool has_normals = normals.has_value();
    const std::size_t first_normal = model_.normals.size() - (has_normals ? count : 0);
    // The numbers of a large file are not kept longer than they are needed.
    positions.reset();
    normals.reset();
    const std::vector<uint32_t> indices = primitive.indices(count);
    const std::size_t triangles = mode == kTriangles ? indices.size() / 3 : indices.size();
    const std::size_t first_triangle = model_.sizes.size();
    make_room(triangles, model_.sizes);
    make_room(3 * triangles, model_.corners);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (mirrored) std::swap(b, c);
      for (const std::size_t i : {a, b, c}) {
        model_.corners.push_back({static_cast<uint32_t>(first + indices[i]),
                                  has_normals ? static_cast<uint32_t>(first_normal + indices[i])
                                              : PolygonCorner::no_normal});
      }
      model_.sizes.push_back(3);
    };
    if (mode == kTriangles) {
      for (std::size_t i = 0; i + 2 < indices.size(); i += 3) add(i, i + 1, i + 2);
    } else {
      for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        if (mode == kFan) {
          add(0, i + 1, i + 2);
        } else if (i % 2 == 0) {
          add(i, i + 1, i + 2);
        } else {
          add(i + 1, i, i + 2);
        }
      }
    }
    add_colors(object, colors, first_triangle, first);
  }

  // Of a primitive's material in linear light, 1,1,1 where it says none; nothing without a material
  // and where a texture has the colour.
  [[nodiscard]] std::optional<dvec3> base_color_of(const json& primitive) const {
    if (!primitive.contains("material")) return std::nullopt;
    const json& material = data_.element("materials", whole(primitive.at("material")));
    const auto metal = material.find("pbrMetallicRoughness");
    if (metal == material.end()) return dvec3(1.0);
    if (metal->contains("baseColorTexture")) return std::nullopt;
    if (!metal->contains("baseColorFactor")) return dvec3(1.0);
    const auto factor = metal->at("baseColorFactor").get<std::vector<double>>();
    if (factor.size() < 3) return std::nullopt;
    return dvec3(factor[0], factor[1], factor[2]);
  }

  // Gives the triangles from `first` on their colours: the base colour times the mean of their
  // corners' in COLOR_0. first_vertex: the number of the first of those in the model.
  void add_colors(const json& object, const std::optional<Table>& vertex_colors, std::size_t first,
                  std::size_t first_vertex) {
    const std::optional<dvec3> base = base_color_of(object);
    const bool is_textured = object.contains("material") && !base;
    if (!vertex_colors || is_textured) {
      add_color(first, base ? std::optional(srgb_color(*base)) : std::nullopt, model_);
      return;
    }
    model_.colors.resize(first, PolygonModel::no_color);
    for (std::size_t corner = 3 * first; corner + 2 < model_.corners.size(); corner += 3) {
      dvec3 sum(0.0);
      for (std::size_t k = corner; k < corner + 3; ++k) {
        sum += vertex_colors->vector(model_.corners[k].position - first_vertex);
      }
      model_.colors.push_back(polygon_color(srgb_color(sum / 3.0 * base.value_or(dvec3(1.0)))));
    }
  }

  // Adds the morph targets' parts to an attribute.
  void add_targets(const json& primitive, const std::vector<double>& weights, const char* name,
                   Table& table) {
    if (!primitive.contains("targets")) return;
    const json& targets = primitive.at("targets");
    for (std::size_t i = 0; i < std::min(targets.size(), weights.size()); ++i) {
      const auto found = targets[i].find(name);
      if (weights[i] == 0.0 || found == targets[i].end()) continue;
      const Table change = data_.table(whole(*found));
      if (change.numbers.size() != table.numbers.size()) {
        data_.fail("a morph target has not as many vertices as its mesh");
      }
      for (std::size_t k = 0; k < table.numbers.size(); ++k) {
        table.numbers[k] += weights[i] * change.numbers[k];
      }
      table.step += std::abs(weights[i]) * change.step;
    }
  }

  // For each vertex of a mesh with a skin what moves it; nothing for one without.
  std::vector<dmat4> bones_of(Primitive& primitive, const json& node, std::size_t count) {
    if (!node.contains("skin")) return {};
    const json& skin = data_.element("skins", whole(node.at("skin")));
    std::vector<dmat4> joints;
    std::optional<Table> inverse;
    if (skin.contains("inverseBindMatrices")) {
      inverse = data_.table(whole(skin.at("inverseBindMatrices")));
    }
    for (const json& joint : skin.at("joints")) {
      const std::size_t number = whole(joint);
      if (number >= placed_.size()) data_.fail("a skin names a node that is not there");
      dmat4 matrix = placed_[number].value_or(dmat4(1.0));
      if (inverse && inverse->columns == 16 && joints.size() < inverse->rows()) {
        dmat4 back(1.0);
        for (int k = 0; k < 16; ++k) {
          back[k / 4][k % 4] = inverse->numbers[16 * joints.size() + static_cast<std::size_t>(k)];
        }
        matrix *= back;
      }
      joints.push_back(matrix);
    }
    std::vector<dmat4> bones(count, dmat4(0.0));
    std::vector<double> sums(count, 0.0);
    for (int set = 0;; ++set) {
      const auto numbers = primitive.attribute(fmt::format("JOINTS_{}", set), 4);
      const auto weights = primitive.attribute(fmt::format("WEIGHTS_{}", set), 4);
      if (!numbers || !weights) break;
      if (numbers->rows() != count || weights->rows() != count) {
        data_.fail("a mesh has not as many joints as vertices");
      }
      for (std::size_t k = 0; k < 4 * count; ++k) {
        const double weight = weights->numbers[k];
        if (weight == 0.0) continue;
        const double joint = numbers->numbers[k];
        if (!(joint >= 0.0 && joint < static_cast<double>(joints.size()))) {
          data_.fail("a vertex names a joint that its skin does not have");
        }
        bones[k / 4] += joints[static_cast<std::size_t>(joint)] * weight;
        sums[k / 4] += weight;
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      bones[i] = sums[i] > 0.0 ? bones[i] / sums[i] : dmat4(1.0);
    }
    return bones;
  }

  Data& data_;
  std::vector<std::optional<dmat4>> placed_;  // of each node of the scene
  PolygonModel model_;
  std::size_t points_ = 0;
  std::size_t lines_ = 0;
  std::size_t without_positions_ = 0;
};

}  // namespace

PolygonModel parse_gltf(std::string_view bytes, const std::filesystem::path& path) {
  const std::string name = path.string();
  try {
    Data data(bytes, path);
    if (!data.root().is_object() || !data.root().contains("asset")) {
      data.fail("is no glTF: it says nothing of an asset");
    }
    // The first glTF had a number here.
    const json& given = data.root().at("asset").at("version");
    const std::string version = given.is_string() ? given.get<std::string>() : gltf::shown(given);
    if (!version.starts_with("2.")) {
      data.fail(fmt::format("is glTF {}; only glTF 2 is read", version));
    }
    return GltfScene(data).assemble();
  } catch (const json::exception& error) {
    std::string_view what(error.what());
    // Without "[json.exception.type_error.302] ".
    if (const std::size_t end = what.find("] "); end != std::string_view::npos) {
      what.remove_prefix(end + 2);
    }
    throw InputError(fmt::format("{}: is not the JSON of a glTF: {}.", name, reason_of(what)));
  }
}

}  // namespace trisect
