#include "app/bench/decimated.h"

#include <meshoptimizer.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "app/base/error.h"
#include "app/mesh/mesh_builder.h"

namespace trisect::bench {
namespace {

// In single precision, which meshoptimizer takes, about one of them.
std::vector<glm::vec3> about_the_first(const std::vector<glm::dvec3>& positions) {
  std::vector<glm::vec3> result;
  result.reserve(positions.size());
  for (const glm::dvec3& position : positions) result.emplace_back(position - positions.front());
  return result;
}

std::vector<uint32_t> indices_of(const FlatMesh& mesh) {
  std::vector<uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) {
    indices.insert(indices.end(), {triangle.x, triangle.y, triangle.z});
  }
  return indices;
}

}  // namespace

Mesh decimated(const FlatMesh& mesh, std::size_t count, const std::string& name) {
  const std::vector<glm::vec3> positions = about_the_first(mesh.positions);
  const std::vector<uint32_t> indices = indices_of(mesh);
  std::vector<uint32_t> left(indices.size());
  // However large the error becomes.
  left.resize(meshopt_simplify(left.data(), indices.data(), indices.size(), &positions.front().x,
                               positions.size(), sizeof(glm::vec3), 3 * count,
                               std::numeric_limits<float>::max(), 0, nullptr));
  constexpr uint32_t none = ~0U;
  std::vector<uint32_t> number(mesh.positions.size(), none);
  std::vector<glm::dvec3> used_positions;
  std::vector<glm::dvec3> used_normals;
  for (uint32_t& vertex : left) {
    if (number[vertex] == none) {
      number[vertex] = static_cast<uint32_t>(used_positions.size());
      used_positions.push_back(mesh.positions[vertex]);
      used_normals.emplace_back(mesh.normals[vertex]);
    }
    vertex = number[vertex];
  }
  if (left.empty()) throw InputError(name + ": nothing is left of it.");
  return build_mesh(used_positions, used_normals, left).mesh;
}

}  // namespace trisect::bench
