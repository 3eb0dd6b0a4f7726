#include "tests/support/scenes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <set>
#include <utility>

#include "app/cli/data_folder.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/stress/stress_scenes.h"

namespace trisect::test {

using glm::dvec3;

const std::vector<std::string>& asset_names() {
  static const std::vector<std::string> names{"sphere-20", "sphere-80", "sphere-320",  "torus",
                                              "relief",    "teapot",    "teapot-1000", "capsule",
                                              "cube",      "saddle"};
  return names;
}

std::string asset_path(const std::string& name) {
  return (data_folder("assets", TRISECT_ASSETS) / (name + ".obj")).string();
}

Mesh load_asset(const std::string& name) {
  return build_mesh(read_model(asset_path(name)), name).mesh;
}

Mesh without_holes(Mesh mesh) {
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (const MeshTriangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.emplace(t.vertex[i], t.vertex[(i + 1) % 3]);
  }
  // What follows a vertex along a hole's border, and the vertex's normal.
  struct Step {
    uint32_t next;
    uint32_t normal;
  };
  std::map<uint32_t, Step> border;
  for (const MeshTriangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const uint32_t next = t.vertex[(i + 1) % 3];
      if (!edges.contains({next, t.vertex[i]})) border[t.vertex[i]] = {next, t.normal[i]};
    }
  }
  while (!border.empty()) {
    std::vector<std::pair<uint32_t, uint32_t>> hole;  // vertices and their normals
    dvec3 middle(0.0);
    for (uint32_t vertex = border.begin()->first; border.contains(vertex);) {
      const Step step = border.extract(vertex).mapped();
      hole.emplace_back(vertex, step.normal);
      middle += mesh.positions[vertex];
      vertex = step.next;
    }
    middle /= static_cast<double>(hole.size());
    const auto center = static_cast<uint32_t>(mesh.positions.size());
    const auto center_normal = static_cast<uint32_t>(mesh.normals.size());
    dvec3 area(0.0);
    for (std::size_t i = 0; i < hole.size(); ++i) {
      const auto [a, a_normal] = hole[i];
      const auto [b, b_normal] = hole[(i + 1) % hole.size()];
      area += glm::cross(mesh.positions[b] - middle, mesh.positions[a] - middle);
      mesh.triangles.push_back({{b, a, center}, {b_normal, a_normal, center_normal}});
    }
    mesh.positions.push_back(middle);
    mesh.normals.push_back(glm::normalize(area));
  }
  return mesh;
}

Mesh one_triangle(const std::array<dvec3, 3>& positions, const std::array<dvec3, 3>& normals) {
  return {{positions.begin(), positions.end()},
          {normals.begin(), normals.end()},
          {{{0, 1, 2}, {0, 1, 2}}}};
}

RandomPatch random_patch(std::mt19937_64& random, double spread) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  RandomPatch patch{};
  dvec3 n(0.0);
  while (glm::length(n) < 1e-3) {
    for (dvec3& p : patch.positions) p = {unit(random), unit(random), unit(random)};
    n = glm::cross(patch.positions[1] - patch.positions[0],
                   patch.positions[2] - patch.positions[0]);
  }
  n = glm::normalize(n);
  const dvec3 s = glm::normalize(patch.positions[1] - patch.positions[0]);
  const dvec3 t = glm::cross(n, s);
  for (dvec3& normal : patch.normals) {
    const double tilt = glm::radians(spread) * unit(random);
    const double turn = 2.0 * glm::pi<double>() * unit(random);
    normal = n * std::cos(tilt) + (s * std::cos(turn) + t * std::sin(turn)) * std::sin(tilt);
  }
  return patch;
}

Mesh wild_patches(int count) {
  std::mt19937_64 random(17);
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    RandomPatch wild = random_patch(random, 90.0);
    const auto& [a, b, c] = wild.normals;
    wild.normals[2] = 0.03 * c - glm::normalize(a * 0.7 + b);
    const glm::ivec3 place(i % 4, i / 4 % 4, i / 16);
    mesh = stress::joined(mesh, stress::patch(wild.positions, wild.normals), dvec3(place) * 1.5);
  }
  return mesh;
}

dvec3 random_weights(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double a = std::sqrt(unit(random));
  const double b = unit(random);
  return {1.0 - a, a * b, a * (1.0 - b)};
}

std::vector<dvec3> weight_grid(int n, bool interior) {
  std::vector<dvec3> weights;
  const int margin = interior ? 1 : 0;
  for (int i = margin; i <= n - margin; ++i) {
    for (int j = margin; i + j <= n - margin; ++j) {
      weights.emplace_back(dvec3(n - i - j, i, j) / static_cast<double>(n));
    }
  }
  return weights;
}

}  // namespace trisect::test
