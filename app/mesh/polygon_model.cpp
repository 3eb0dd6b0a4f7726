#include "app/mesh/polygon_model.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/base/srgb.h"

namespace trisect {

glm::dmat3 matrix_for_normals(const glm::dmat3& m) {
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                             glm::cross(m[0], m[1]));
  return glm::determinant(m) < 0.0 ? -cofactors : cofactors;
}

bool add_vertex(const glm::dvec3& position, const glm::dvec3* normal, PolygonModel& model) {
  const auto is_finite = [](const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); };
  model.positions.push_back(position);
  if (normal != nullptr) model.normals.push_back(is_finite(*normal) ? *normal : glm::dvec3(0.0));
  return is_finite(position);
}

glm::vec3 polygon_color(const glm::vec3& color) {
  // Written so that a NaN is no colour.
  return color.x + color.y + color.z > -1e30F ? glm::clamp(color, 0.0F, 1.0F)
                                              : PolygonModel::no_color;
}

void add_color(std::size_t first, const std::optional<glm::vec3>& color, PolygonModel& model) {
  if (!color && model.colors.empty()) return;
  // Earlier polygons may have come without one.
  model.colors.resize(first, PolygonModel::no_color);
  model.colors.resize(model.sizes.size(), color ? polygon_color(*color) : PolygonModel::no_color);
}

glm::vec3 srgb_color(const glm::dvec3& linear) {
  const glm::vec3 single(linear);
  return {srgb_from_linear(single.x), srgb_from_linear(single.y), srgb_from_linear(single.z)};
}

void note_left_out(std::size_t count, const char* what, PolygonModel& model) {
  if (count == 0) return;
  model.notes.push_back(fmt::format("{} {}{} left out", count, what, count == 1 ? "" : "s"));
}

std::string notes_after_semicolon(const PolygonModel& model) {
  return model.notes.empty() ? "" : fmt::format("; {}", fmt::join(model.notes, ", "));
}

void add_group(std::string name, std::size_t first, std::vector<PolygonGroup>& groups) {
  close_groups(first, groups);
  if (groups.empty() && first > 0) groups.push_back({"", 0});
  groups.push_back({std::move(name), first});
}

void close_groups(std::size_t polygons, std::vector<PolygonGroup>& groups) {
  if (!groups.empty() && groups.back().first == polygons) groups.pop_back();
}

}  // namespace trisect
