// The models: generated, whole, and with the normals of the surfaces they stand for.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "tests/support/file_content.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

const std::filesystem::path kGenerated(TRISECT_GENERATED_ASSETS);

TEST(Assets, AreWhatTheGeneratorWrites) {
  for (const std::string& name : test::asset_names()) {
    const std::string text = test::content_of(test::asset_path(name));
    EXPECT_FALSE(text.empty()) << name;
    EXPECT_EQ(text, test::content_of(kGenerated / (name + ".obj"))) << name;
    EXPECT_LT(text.size(), 200U * 1024U) << name;
  }
}

TEST(Assets, HaveTheTrianglesAndEdgesTheyShould) {
  struct Expected {
    std::size_t triangles, open_edges, hard_edges;
  };
  // The teapot's rim, lid, handle and spout are open, as designed: 4 edges to a quarter turn or
  // half tube, two turns for rim and lid, two ends of handle and spout.
  const std::map<std::string, Expected> models{
      {"sphere-20", {20, 0, 0}},      {"sphere-80", {80, 0, 0}},      {"sphere-320", {320, 0, 0}},
      {"torus", {256, 0, 0}},         {"capsule", {224, 0, 0}},       {"cube", {12, 0, 12}},
      {"relief", {80, 26, 0}},        {"saddle", {32, 16, 0}},        {"teapot", {304, 32, 0}},
      {"teapot-1000", {1016, 60, 0}}, {"teapot-4000", {4000, 116, 0}}};
  for (const auto& [name, expected] : models) {
    const BuiltMesh built = build_mesh(read_model(kGenerated / (name + ".obj")), name);
    EXPECT_EQ(built.report.triangles, expected.triangles) << name;
    EXPECT_EQ(built.report.open_edges, expected.open_edges) << name;
    EXPECT_EQ(built.report.hard_edges, expected.hard_edges) << name;
    EXPECT_EQ(built.report.degenerate_dropped, 0U) << name;
    EXPECT_EQ(built.report.non_manifold_edges, 0U) << name;
    EXPECT_EQ(built.report.flipped_edges, 0U) << name;
    EXPECT_EQ(built.report.normals, NormalSource::file) << name;
  }
}

// The corners of a mesh as pairs of position and normal.
std::vector<std::pair<glm::dvec3, glm::dvec3>> corners(const std::string& name) {
  const Mesh mesh = test::load_asset(name);
  std::vector<std::pair<glm::dvec3, glm::dvec3>> all;
  for (const MeshTriangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      all.emplace_back(mesh.positions[t.vertex[i]], mesh.normals[t.normal[i]]);
    }
  }
  return all;
}

// Nine digits are written: up to 5e-9 off in each coordinate above 1.
constexpr double kDigits = 1e-8;

TEST(Assets, SphereNormalsAreThePositions) {
  for (const char* name : {"sphere-20", "sphere-80", "sphere-320"}) {
    for (const auto& [p, n] : corners(name)) {
      EXPECT_NEAR(glm::length(p), 1.0, kDigits);
      EXPECT_LT(glm::distance(p, n), kDigits);
    }
  }
}

TEST(Assets, TorusNormalsPointFromItsCircle) {
  for (const auto& [p, n] : corners("torus")) {
    const glm::dvec3 middle = glm::normalize(glm::dvec3(p.x, 0.0, p.z));
    EXPECT_LT(glm::distance(p, middle + n * 0.4), kDigits);
  }
}

TEST(Assets, CapsuleNormalsPointFromItsAxis) {
  for (const auto& [p, n] : corners("capsule")) {
    EXPECT_LT(glm::distance(p, glm::dvec3(0.0, glm::clamp(p.y, -0.5, 0.5), 0.0) + n * 0.5),
              kDigits);
  }
}

TEST(Assets, TeapotStandsUprightWithItsNormalsOutward) {
  glm::dvec3 low(1e9);
  glm::dvec3 high(-1e9);
  std::size_t outward = 0;
  std::size_t on_body = 0;
  for (const auto& [p, n] : corners("teapot-1000")) {
    low = glm::min(low, p);
    high = glm::max(high, p);
    // Around the belly there is nothing but the body's wall, handle and spout aside.
    if (p.y > 0.5 && p.y < 1.2 && std::abs(p.x) < 1.3) {
      ++on_body;
      if (glm::dot(n, glm::dvec3(p.x, 0.0, p.z)) > 0.0) ++outward;
    }
  }
  // Newell's figures: 0 to 3.15 high, handle to spout -3 to 3.43, 2 to either side.
  EXPECT_NEAR(low.y, 0.0, kDigits);
  EXPECT_NEAR(high.y, 3.15, kDigits);
  EXPECT_NEAR(high.z, 2.0, kDigits);
  EXPECT_NEAR(low.z, -2.0, kDigits);
  EXPECT_NEAR(low.x, -3.0, 0.01);
  EXPECT_NEAR(high.x, 3.43, 0.01);
  EXPECT_GT(on_body, 50U);
  EXPECT_EQ(outward, on_body);
}

}  // namespace
}  // namespace trisect
