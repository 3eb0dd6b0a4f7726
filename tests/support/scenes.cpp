#include "tests/support/scenes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "app/mesh_builder.h"

namespace trisect::test {

using glm::dvec3;

const std::vector<std::string>& asset_names() {
  static const std::vector<std::string> names{"sphere-20", "sphere-80", "sphere-320",  "torus",
                                              "relief",    "teapot",    "teapot-1000", "capsule",
                                              "cube",      "saddle"};
  return names;
}

std::string asset_path(const std::string& name) {
  return TRISECT_ASSETS "/" + name + ".obj";
}

Mesh load_asset(const std::string& name) {
  return build_mesh(read_obj(asset_path(name)), name).mesh;
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
