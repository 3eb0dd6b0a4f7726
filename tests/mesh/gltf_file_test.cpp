#include "app/mesh/gltf_file.h"

#include <draco/compression/encode.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/report/document.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

using glm::dvec3;
using nlohmann::json;

template <typename T>
std::string as_bytes(const std::vector<T>& numbers) {
  std::string bytes(numbers.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

// A file with one buffer, to which accessors are added.
class GltfText {
 public:
  GltfText() {
    root_["asset"]["version"] = "2.0";
    for (const char* key : {"accessors", "bufferViews", "meshes", "nodes"}) {
      root_[key] = json::array();
    }
  }

  json& root() { return root_; }

  // Returns the view's number.
  std::size_t add_view(const std::string& bytes) {
    root_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
    bytes_ += bytes;
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    return root_["bufferViews"].size() - 1;
  }

  template <typename T>
  std::size_t add(const std::vector<T>& numbers, uint32_t component_type, const char* type,
                  std::size_t columns, bool normalised = false) {
    json accessor{{"bufferView", add_view(as_bytes(numbers))},
                  {"componentType", component_type},
                  {"type", type},
                  {"count", numbers.size() / columns}};
    if (normalised) accessor["normalized"] = true;
    root_["accessors"].push_back(accessor);
    return root_["accessors"].size() - 1;
  }
  std::size_t add_vectors(const std::vector<float>& numbers) {
    return add(numbers, 5126, "VEC3", 3);
  }

  void add_mesh(const json& primitive) {
    root_["meshes"].push_back({{"primitives", json::array({primitive})}});
  }
  void add_node(const json& node) { root_["nodes"].push_back(node); }

  [[nodiscard]] std::string text() const {
    json root = root_;
    root["buffers"] = {
        {{"byteLength", bytes_.size()},
         {"uri", "data:application/octet-stream;base64," + report::base64_of(bytes_)}}};
    return root.dump();
  }
  [[nodiscard]] std::string binary() const {
    json root = root_;
    root["buffers"] = {{{"byteLength", bytes_.size()}}};
    std::string text = root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto chunk = [](uint32_t type, const std::string& bytes) {
      return as_bytes(std::vector<uint32_t>{static_cast<uint32_t>(bytes.size()), type}) + bytes;
    };
    const std::string chunks = chunk(0x4E4F534A, text) + chunk(0x004E4942, bytes_);
    return "glTF" + as_bytes(std::vector<uint32_t>{2U, static_cast<uint32_t>(chunks.size() + 12)}) +
           chunks;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  json root_;
  std::string bytes_;
};

const std::vector<float> kSquareCorners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

PolygonModel parse_bytes(const std::string& bytes) {
  return parse_gltf(bytes, "model.gltf");
}

std::string refusal(const std::string& bytes) {
  try {
    parse_bytes(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// The positions that the triangles' corners name, one triangle after the other.
std::vector<dvec3> corner_points(const PolygonModel& model) {
  std::vector<dvec3> corners;
  for (const PolygonCorner& corner : model.corners) {
    corners.push_back(model.positions[corner.position]);
  }
  return corners;
}

GltfText square_file(uint32_t mode = 4) {
  GltfText file;
  file.add_mesh({{"attributes", {{"POSITION", file.add_vectors(kSquareCorners)}}}, {"mode", mode}});
  return file;
}

TEST(GltfFile, ReadsTrianglesAsTextAndAsBinary) {
  GltfText file;
  const std::size_t positions = file.add_vectors(kSquareCorners);
  const std::size_t normals = file.add_vectors({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 2});
  const std::size_t indices = file.add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
  file.add_mesh(
      {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}});
  file.add_node({{"mesh", 0}});
  for (const std::string& bytes : {file.text(), file.binary()}) {
    const PolygonModel model = parse_bytes(bytes);
    EXPECT_EQ(model.sizes, (std::vector<uint32_t>{3, 3}));
    EXPECT_EQ(
        corner_points(model),
        (std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(model.normals[model.corners[5].normal], dvec3(0, 0, 2));
    EXPECT_TRUE(model.notes.empty());
  }
}

// Position and normal of a vertex one after the other, in one view that both accessors share.
TEST(GltfFile, ReadsInterleavedVertices) {
  GltfText file;
  const std::vector<float> vertices{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0};
  const std::size_t view = file.add_view(as_bytes(vertices));
  file.root()["bufferViews"][view]["byteStride"] = 24;
  for (const int offset : {0, 12}) {
    file.root()["accessors"].push_back({{"bufferView", view},
                                        {"byteOffset", offset},
                                        {"componentType", 5126},
                                        {"type", "VEC3"},
                                        {"count", 3}});
  }
  file.add_mesh({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}});
  file.add_node({{"mesh", 0}});
  const PolygonModel model = parse_bytes(file.text());
  EXPECT_EQ(corner_points(model), (std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  ASSERT_EQ(model.corners.size(), 3U);
  EXPECT_EQ(model.normals[model.corners[0].normal], dvec3(0, 0, 1));
  EXPECT_EQ(model.normals[model.corners[1].normal], dvec3(0, 1, 0));
  EXPECT_EQ(model.normals[model.corners[2].normal], dvec3(1, 0, 0));
}

TEST(GltfFile, KeepsTheNamesOfMeshes) {
  GltfText file = square_file(6);
  file.root()["meshes"][0]["name"] = "first";
  file.add_mesh({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  file.add_mesh({{"attributes", {{"POSITION", 0}}}, {"mode", 6}});
  const PolygonModel model = parse_bytes(file.text());
  ASSERT_EQ(model.groups.size(), 2U);
  EXPECT_EQ(model.groups[0].name, "first");
  EXPECT_EQ(model.groups[0].first, 0U);
  EXPECT_EQ(model.groups[1].name, "");
  EXPECT_EQ(model.groups[1].first, 2U);
}

TEST(GltfFile, ReadsIndicesOfEverySize) {
  for (const uint32_t type : {5121U, 5123U, 5125U}) {
    GltfText file;
    const std::size_t positions = file.add_vectors(kSquareCorners);
    const std::size_t indices =
        type == 5121   ? file.add(std::vector<uint8_t>{0, 1, 3}, type, "SCALAR", 1)
        : type == 5123 ? file.add(std::vector<uint16_t>{0, 1, 3}, type, "SCALAR", 1)
                       : file.add(std::vector<uint32_t>{0, 1, 3}, type, "SCALAR", 1);
    file.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    EXPECT_EQ(corner_points(parse_bytes(file.text()))[2], dvec3(0, 1, 0)) << type;
  }
}

TEST(GltfFile, TurnsStripsAndFansTheSameWay) {
  // Corners 0, 1, 3, 2 make a strip of the square, 0, 1, 2, 3 a fan.
  GltfText strip;
  const std::size_t positions = strip.add_vectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  strip.add_mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}});
  for (const GltfText& file : {strip, square_file(6)}) {
    const std::vector<dvec3> corners = corner_points(parse_bytes(file.text()));
    ASSERT_EQ(corners.size(), 6U);
    for (std::size_t i = 0; i < 6; i += 3) {
      EXPECT_EQ(glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]),
                dvec3(0, 0, 1));
    }
  }
}

TEST(GltfFile, LeavesOutPointsAndLines) {
  GltfText file = square_file(6);
  for (const uint32_t mode : {0U, 1U, 3U}) {
    file.add_mesh({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  }
  EXPECT_EQ(parse_bytes(file.text()).notes,
            (std::vector<std::string>{"1 point primitive left out", "2 line primitives left out"}));
  EXPECT_EQ(refusal(square_file(1).text()),
            "model.gltf: the file has no faces; 1 line primitive left out.");
}

TEST(GltfFile, AppliesTransformationsOfNodes) {
  GltfText file;
  const std::size_t positions = file.add_vectors(kSquareCorners);
  const std::size_t normals = file.add_vectors({0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 1});
  file.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"mode", 6}});
  // The parent mirrors x, the child moves along it and is half as high along z.
  file.add_node({{"children", {1}}, {"scale", {-1, 1, 1}}});
  file.add_node({{"mesh", 0}, {"translation", {2, 0, 0}}, {"scale", {1, 1, 0.5}}});
  file.root()["scenes"] = {{{"nodes", {0}}}};
  const PolygonModel model = parse_bytes(file.text());
  EXPECT_EQ(model.positions[1], dvec3(-3, 0, 0));
  // Mirrored triangles stay on the side of their normals.
  const std::vector<dvec3> corners = corner_points(model);
  EXPECT_GT(glm::cross(corners[1] - corners[0], corners[2] - corners[0]).z, 0.0);
  EXPECT_GT(model.normals[0].z, 0.0);
  // The slanted normal turns against the stretching: (1, 0, 1) to (-1, 0, 2).
  EXPECT_LT(glm::distance(glm::normalize(model.normals[3]), glm::normalize(dvec3(-1, 0, 2))),
            1e-15);
  // A quarter turn about z, as a matrix and as a quaternion.
  const double h = 0.7071067811865476;
  for (const json& node :
       {json{{"mesh", 0}, {"rotation", {0, 0, h, h}}},
        json{{"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}) {
    GltfText turned = file;
    turned.root()["nodes"] = {node};
    EXPECT_LT(glm::distance(parse_bytes(turned.text()).positions[1], dvec3(0, 1, 0)), 1e-15);
  }
}

TEST(GltfFile, ReadsQuantisedAccessors) {
  GltfText file;
  const std::size_t positions =
      file.add(std::vector<uint16_t>{0, 0, 0, 65535, 0, 0, 65535, 65535, 0, 0, 65535, 0}, 5123,
               "VEC3", 3, true);
  const std::size_t normals = file.add(
      std::vector<int8_t>{0, 0, 127, 0, 0, 127, 0, -128, 0, 0, 127, 127}, 5120, "VEC3", 3, true);
  file.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"mode", 6}});
  file.add_node({{"mesh", 0}, {"scale", {3, 3, 3}}});
  const PolygonModel model = parse_bytes(file.text());
  EXPECT_EQ(model.positions[2], dvec3(3, 3, 0));
  EXPECT_EQ(model.normals[2].y, -9.0);  // cofactors of a scale by 3
  // Half a step in each direction.
  EXPECT_NEAR(model.position_rounding, 0.5 * std::sqrt(3.0) * 3.0 / 65535.0, 1e-15);
  EXPECT_NEAR(model.normal_rounding, 0.5 * std::sqrt(3.0) / 127.0, 1e-6);
  // Of floats there are none.
  const PolygonModel floats = parse_bytes(square_file(6).text());
  EXPECT_EQ(floats.position_rounding, 0.0);
  EXPECT_EQ(floats.normal_rounding, 0.0);
}

TEST(GltfFile, ReplacesElementsOfSparseAccessors) {
  GltfText file = square_file(6);
  const std::size_t places = file.add_view(as_bytes(std::vector<uint16_t>{2}));
  const std::size_t values = file.add_view(as_bytes(std::vector<float>{5, 6, 7}));
  file.root()["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", places}, {"componentType", 5123}}},
      {"values", {{"bufferView", values}}}};
  EXPECT_EQ(parse_bytes(file.text()).positions[2], dvec3(5, 6, 7));
  EXPECT_EQ(parse_bytes(file.text()).positions[1], dvec3(1, 0, 0));
}

TEST(GltfFile, TakesMorphTargetsAndSkinsAtRest) {
  GltfText file = square_file(6);
  const std::size_t up = file.add_vectors({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  file.root()["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}};
  file.root()["meshes"][0]["weights"] = {0.25};
  EXPECT_EQ(parse_bytes(file.text()).positions[1], dvec3(1, 0, 0.25));
  // The node's weights go before; two joints, one of which has moved.
  const std::size_t joints = file.add(
      std::vector<uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, 5121, "VEC4", 4);
  const std::size_t weights = file.add(
      std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 4);
  json& attributes = file.root()["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = joints;
  attributes["WEIGHTS_0"] = weights;
  file.root()["skins"] = {{{"joints", {1, 2}}}};
  file.add_node({{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}, {"translation", {100, 0, 0}}});
  file.add_node(json::object());
  file.add_node({{"translation", {0, 0, 4}}});
  const PolygonModel model = parse_bytes(file.text());
  EXPECT_EQ(model.positions[0], dvec3(0, 0, 0.5));
  EXPECT_EQ(model.positions[1], dvec3(1, 0, 4.5));
  EXPECT_EQ(model.positions[2], dvec3(1, 1, 2.5));
}

// Each morph target adds its own step, as much of it as it is taken; a skin turns and scales the
// sum.
TEST(GltfFile, AddsTheStepsOfMorphTargets) {
  GltfText file;
  const std::vector<uint16_t> corners{0, 0, 0, 65535, 0, 0, 65535, 65535, 0, 0, 65535, 0};
  const std::size_t positions = file.add(corners, 5123, "VEC3", 3, true);
  const std::size_t up = file.add(std::vector<int8_t>{0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 127},
                                  5120, "VEC3", 3, true);
  const std::size_t joints = file.add(std::vector<uint8_t>(16, 0), 5121, "VEC4", 4);
  const std::size_t weights =
      file.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 4);
  file.add_mesh(
      {{"mode", 6},
       {"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
       {"targets", {{{"POSITION", up}}}}});
  file.root()["meshes"][0]["weights"] = {-0.25};
  file.root()["skins"] = {{{"joints", {1}}}};
  file.add_node({{"mesh", 0}, {"skin", 0}});
  file.add_node({{"scale", {3, 3, 3}}});
  EXPECT_NEAR(parse_bytes(file.text()).position_rounding,
              3.0 * 0.5 * std::sqrt(3.0) * (1.0 / 65535.0 + 0.25 / 127.0), 1e-15);
}

TEST(GltfFile, UnpacksMeshopt) {
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(4, 12));
  packed.resize(
      meshopt_encodeVertexBuffer(packed.data(), packed.size(), kSquareCorners.data(), 4, 12));
  const std::vector<uint16_t> triangles{0, 1, 2, 0, 2, 3};
  std::vector<unsigned char> packed_indices(meshopt_encodeIndexBufferBound(6, 4));
  const std::vector<uint32_t> wide(triangles.begin(), triangles.end());
  packed_indices.resize(
      meshopt_encodeIndexBuffer(packed_indices.data(), packed_indices.size(), wide.data(), 6));
  GltfText file;
  // The views' own buffer is one that need not be there.
  const auto add_packed = [&](const std::vector<unsigned char>& bytes, std::size_t count,
                              std::size_t stride, const char* mode) {
    const std::size_t view = file.add_view(as_bytes(bytes));
    json& object = file.root()["bufferViews"][view];
    const json place{
        {"buffer", 0}, {"byteOffset", object["byteOffset"]}, {"byteLength", bytes.size()}};
    json extension = place;
    extension.update({{"byteStride", stride}, {"count", count}, {"mode", mode}});
    object = {{"buffer", 1},
              {"byteLength", count * stride},
              {"extensions", {{"EXT_meshopt_compression", extension}}}};
    return view;
  };
  file.root()["accessors"] = {{{"bufferView", add_packed(packed, 4, 12, "ATTRIBUTES")},
                               {"componentType", 5126},
                               {"type", "VEC3"},
                               {"count", 4}},
                              {{"bufferView", add_packed(packed_indices, 6, 2, "TRIANGLES")},
                               {"componentType", 5123},
                               {"type", "SCALAR"},
                               {"count", 6}}};
  file.add_mesh({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
  const PolygonModel model = parse_bytes(file.text());
  ASSERT_EQ(model.positions.size(), 4U);
  EXPECT_EQ(model.positions[2], dvec3(1, 1, 0));
  EXPECT_EQ(model.sizes.size(), 2U);
  file.root()["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 5000;
  EXPECT_EQ(refusal(file.text()), "model.gltf: buffer view 0 cannot be unpacked.");
}

TEST(GltfFile, UnpacksDraco) {
  draco::Mesh mesh;
  mesh.set_num_points(4);
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id = mesh.AddAttribute(attribute, true, 4);
  for (uint32_t i = 0; i < 4; ++i) {
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                          &kSquareCorners[std::size_t{3} * i]);
  }
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)});
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(2), draco::PointIndex(3)});
  draco::EncoderBuffer packed;
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(mesh, &packed).ok());
  GltfText file;
  const std::size_t view = file.add_view(std::string(packed.data(), packed.size()));
  file.root()["accessors"] = {{{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}},
                              {{"componentType", 5125}, {"type", "SCALAR"}, {"count", 6}}};
  file.add_mesh({{"attributes", {{"POSITION", 0}}},
                 {"indices", 1},
                 {"extensions",
                  {{"KHR_draco_mesh_compression",
                    {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}});
  const PolygonModel model = parse_bytes(file.text());
  ASSERT_EQ(model.sizes.size(), 2U);
  EXPECT_EQ(corner_points(model)[2], dvec3(1, 1, 0));
  EXPECT_TRUE(std::isinf(model.position_rounding));
  // Half of it is none.
  file.root()["bufferViews"][0]["byteLength"] = packed.size() / 2;
  EXPECT_NE(refusal(file.text()).find("a mesh cannot be unpacked"), std::string::npos);
}

TEST(GltfFile, ReadsBuffersBesideItAndNoOthers) {
  const test::TemporaryFolder folder;
  const GltfText file = square_file(6);
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_directory(folder / "sub/data");
  for (const char* place : {"outside.bin", "sub/a b.bin", "sub/data/c.bin"}) {
    std::ofstream(folder / place, std::ios::binary) << file.bytes();
  }
  const auto read = [&](const std::string& uri) -> std::string {
    json root = json::parse(file.text());
    root["buffers"][0]["uri"] = uri;
    try {
      return std::to_string(parse_gltf(root.dump(), folder / "sub/model.gltf").sizes.size());
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(read("a%20b.bin"), "2");
  EXPECT_EQ(read("a b.bin"), "2");
  EXPECT_EQ(read("data/../data/c.bin"), "2");
  for (const std::string& uri :
       {std::string("../outside.bin"), std::string("data/../../outside.bin"),
        std::string("%2e%2e/outside.bin"), (folder / "outside.bin").string()}) {
    EXPECT_NE(read(uri).find("names a buffer outside its folder"), std::string::npos) << read(uri);
  }
  EXPECT_NE(read("none.bin").find("none.bin: cannot be opened"), std::string::npos);
}

TEST(GltfFile, SaysWhatIsWrong) {
  const auto with = [](const auto& change) {
    GltfText file = square_file(6);
    file.add_node({{"mesh", 0}});
    change(file.root());
    return refusal(file.text());
  };
  EXPECT_EQ(with([](json& root) { root.erase("asset"); }),
            "model.gltf: is no glTF: it says nothing of an asset.");
  EXPECT_EQ(with([](json& root) { root["asset"]["version"] = "1.0"; }),
            "model.gltf: is glTF 1.0; only glTF 2 is read.");
  EXPECT_EQ(with([](json& root) { root["nodes"][0]["mesh"] = 3; }),
            "model.gltf: names number 3 of its meshes, of which there are 1.");
  EXPECT_EQ(with([](json& root) { root["nodes"][0]["children"] = {0}; }),
            "model.gltf: the file has no faces.");
  EXPECT_EQ(with([](json& root) {
              root["nodes"][0]["children"] = {0};
              root["scenes"] = {{{"nodes", {0}}}};
            }),
            "model.gltf: node 0 has several parents, or is its own.");
  EXPECT_EQ(with([](json& root) { root["accessors"][0]["count"] = 5; }),
            "model.gltf: accessor 0 goes beyond its buffer view.");
  EXPECT_EQ(with([](json& root) { root["accessors"][0]["count"] = 4000000000U; }),
            "model.gltf: accessor 0 goes beyond its buffer view.");
  EXPECT_EQ(with([](json& root) { root["accessors"][0]["type"] = "VEC5"; }),
            "model.gltf: accessor 0 has an unknown type.");
  EXPECT_EQ(with([](json& root) { root["bufferViews"][0]["byteLength"] = 480; }),
            "model.gltf: buffer 0 ends before what is named of it.");
  EXPECT_EQ(with([](json& root) { root["accessors"][0]["count"] = -1; }),
            "model.gltf: is not the JSON of a glTF: a whole number was expected, not -1.");
  EXPECT_NE(refusal("{\"asset\": ").find("is not the JSON of a glTF: "), std::string::npos);
  GltfText file = square_file();
  const std::size_t indices = file.add(std::vector<uint16_t>{0, 1, 9}, 5123, "SCALAR", 1);
  file.root()["meshes"][0]["primitives"][0]["indices"] = indices;
  EXPECT_EQ(refusal(file.text()), "model.gltf: a mesh of 4 vertices names vertex 9.");
  const std::string binary = square_file(6).binary();
  EXPECT_EQ(refusal(binary.substr(0, 16)), "model.gltf: is cut off.");
  EXPECT_EQ(refusal(binary.substr(0, binary.size() - 8)), "model.gltf: is cut off.");
}

// Linear light in the file, white where it says nothing; where a texture has the colour nothing is
// known of it.
TEST(GltfFile, TakesTheColoursOfMaterials) {
  GltfText file = square_file(6);
  json primitive = file.root()["meshes"][0]["primitives"][0];
  EXPECT_TRUE(parse_bytes(file.text()).colors.empty());
  file.root()["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorFactor", {1.0, 0.2140411, 0.0, 0.5}}}}},
      {{"pbrMetallicRoughness",
        {{"baseColorFactor", {1, 1, 1, 1}}, {"baseColorTexture", {{"index", 0}}}}}},
      {{"name", "nothing said"}},
      {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
  for (const int material : {0, 1, 2, 3}) {
    primitive["material"] = material;
    file.root()["meshes"][0]["primitives"].push_back(primitive);
  }
  const PolygonModel model = parse_bytes(file.text());
  ASSERT_EQ(model.colors.size(), 10U);
  const glm::vec3 none = PolygonModel::no_color;
  const std::array<glm::vec3, 5> expected{
      none, {1.0F, 0.5F, 0.0F}, none, glm::vec3(1), glm::vec3(1)};
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_LT(glm::distance(model.colors[i], expected[i / 2]), 1e-6F) << i;
  }
  file.root()["meshes"][0]["primitives"][1]["material"] = 4;
  EXPECT_NE(refusal(file.text()), "");
}

// The mean of a triangle's corners in linear light, times the base colour.
TEST(GltfFile, TakesTheColoursOfVertices) {
  for (const bool normalised : {false, true}) {
    GltfText file = square_file(6);
    json& primitive = file.root()["meshes"][0]["primitives"][0];
    primitive["attributes"]["COLOR_0"] =
        normalised ? file.add(std::vector<uint8_t>{255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255,
                                                   0, 255, 0, 255},
                              5121, "VEC4", 4, true)
                   : file.add_vectors({1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0});
    file.root()["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.2140411, 1, 1, 1}}}}}};
    primitive["material"] = 0;
    const PolygonModel model = parse_bytes(file.text());
    ASSERT_EQ(model.colors.size(), 2U);
    EXPECT_LT(glm::distance(model.colors[0], glm::vec3(0.5F, 0.0F, 0.0F)), 1e-6F);
    EXPECT_LT(glm::distance(model.colors[1], srgb_color({0.2140411 * 2.0 / 3.0, 1.0 / 3.0, 0.0})),
              1e-6F);
    primitive["attributes"]["COLOR_0"] = file.add_vectors({1, 0, 0});
    EXPECT_NE(refusal(file.text()).find("not a colour for each vertex"), std::string::npos);
  }
}

}  // namespace
}  // namespace trisect
