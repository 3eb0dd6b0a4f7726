#include "app/tessellation/surface_vertices.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec3;

constexpr uint32_t kNoVertex = 0xffffffffU;

uint64_t pair_of(uint32_t a, uint32_t b) {
  return (uint64_t{a} << 32U) | b;
}

}  // namespace

SurfaceVertices::SurfaceVertices(const Mesh& mesh, const BakedScene& scene)
    : mesh_(mesh),
      scene_(scene),
      shape_(shape_of(scene.choice)),
      first_of_place_(mesh.positions.size(), kNoVertex) {}

uint32_t SurfaceVertices::at_corner(uint32_t patch, std::size_t corner) {
  const uint32_t place = mesh_.triangles[patch].vertex[corner];
  // Normals count as the surface has them, in single precision.
  const glm::vec3 normal(scene_.triangles[patch].Normal[static_cast<int>(corner)]);
  // The latest ones: of many sharp faces around a place, the neighbours'. Whoever is not found gets
  // a vertex of its own, at the same place.
  constexpr int most = 64;
  uint32_t v = first_of_place_[place];
  for (int looked = 0; v != kNoVertex && looked < most; v = next_[v], ++looked) {
    if (glm::distance(dvec3(normals_[v]), dvec3(normal)) <= kSameNormal) return v;
  }
  return add(mesh_.positions[place], normal, place);
}

uint32_t SurfaceVertices::within(uint32_t patch, const dvec3& weights) {
  const auto place = static_cast<uint32_t>(first_of_place_.size());
  first_of_place_.push_back(kNoVertex);
  return on_surface(patch, weights, place);
}

SurfaceVertices::Between SurfaceVertices::between(uint32_t patch, const PieceCorner& a,
                                                  const PieceCorner& b, uint32_t count) {
  // By the places, so that both sides of a hard edge count from the same end.
  if (place_[a.vertex] > place_[b.vertex]) return {between(patch, b, a, count).first, true};
  const auto [vertices, is_new] = vertices_between_.try_emplace(
      pair_of(a.vertex, b.vertex), static_cast<uint32_t>(positions_.size()));
  if (!is_new) return {vertices->second, false};
  const auto [place, is_divided_now] =
      places_between_.try_emplace(edge(a, b), static_cast<uint32_t>(first_of_place_.size()));
  if (is_divided_now) first_of_place_.resize(first_of_place_.size() + count, kNoVertex);
  for (uint32_t i = 0; i < count; ++i) {
    const double along = static_cast<double>(i + 1) / static_cast<double>(count + 1);
    on_surface(patch, a.weights * (1.0 - along) + b.weights * along, place->second + i);
  }
  return {vertices->second, false};
}

uint64_t SurfaceVertices::edge(const PieceCorner& a, const PieceCorner& b) const {
  const auto [low, high] = std::minmax(place_[a.vertex], place_[b.vertex]);
  return pair_of(low, high);
}

void SurfaceVertices::forget_edges() {
  vertices_between_.clear();
  places_between_.clear();
}

dvec3 SurfaceVertices::surface_point(uint32_t patch, const dvec3& weights) const {
  return scene_.origin +
         in_double::surface_point(shape_, to_double(scene_.triangles[patch]), weights);
}

uint32_t SurfaceVertices::add(const dvec3& position, const glm::vec3& normal, uint32_t place) {
  const auto vertex = static_cast<uint32_t>(positions_.size());
  positions_.push_back(position);
  normals_.push_back(normal);
  place_.push_back(place);
  next_.push_back(std::exchange(first_of_place_[place], vertex));
  return vertex;
}

uint32_t SurfaceVertices::on_surface(uint32_t patch, const dvec3& weights, uint32_t place) {
  const in_double::Triangle tri = to_double(scene_.triangles[patch]);
  dvec3 normal = in_double::vertex_normal(tri, weights);
  const double length = glm::length(normal);
  normal = length > 0.0 ? normal / length : in_double::geometric_normal(shape_, tri, weights);
  dvec3 point = scene_.origin + in_double::surface_point(shape_, tri, weights);
  // Where the shell's directions cancel out there is no surface; the bound says that it is unknown.
  const auto is_finite = [](const dvec3& v) { return std::isfinite(glm::dot(v, v)); };
  if (!is_finite(normal)) normal = dvec3(tri.TriNormal);
  if (!is_finite(point)) point = scene_.origin + in_double::base_point(tri, weights);
  return add(joined(point, place), glm::vec3(normal), place);
}

// The nearest vertex of the same place instead of a point, if it is near enough.
dvec3 SurfaceVertices::joined(const dvec3& point, uint32_t place) const {
  // With every normal turned by t radians, alpha sum_{i<j} w_i w_j (P_j - P_i).(N_j - N_i) changes
  // by less than alpha t times the longest edge, which is less than twice the radius.
  double nearest = 4.0 * kSameNormal * scene_.extent;
  dvec3 at = point;
  for (uint32_t v = first_of_place_[place]; v != kNoVertex; v = next_[v]) {
    const double distance = glm::distance(point, positions_[v]);
    if (distance > nearest) continue;
    nearest = distance;
    at = positions_[v];
  }
  return at;
}

}  // namespace trisect
