#include "app/mesh/polygon.h"

#include <cmath>
#include <cstddef>
#include <numeric>

namespace trisect {
namespace {

// Twice the polygon's vector area (Newell's method), which is well defined for polygons that are
// not quite planar.
glm::dvec3 newell_normal(std::span<const glm::dvec3> corners) {
  glm::dvec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return normal;
}

// The corners projected on the coordinate plane most nearly parallel to the polygon, with their
// orientation kept.
std::vector<glm::dvec2> project(std::span<const glm::dvec3> corners) {
  const glm::dvec3 normal = newell_normal(corners);
  const glm::dvec3 size = glm::abs(normal);
  const int drop = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const int first = (drop + 1) % 3;
  const int second = (drop + 2) % 3;
  const bool mirrored = normal[drop] < 0.0;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 p = corner - corners[0];
    flat.emplace_back(mirrored ? p[second] : p[first], mirrored ? p[first] : p[second]);
  }
  return flat;
}

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inside(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
         turn(c, a, p) >= 0.0;
}

}  // namespace

std::vector<std::array<uint32_t, 3>> triangulate(std::span<const glm::dvec3> corners) {
  const std::vector<glm::dvec2> points = project(corners);
  std::vector<uint32_t> ring(corners.size());
  std::iota(ring.begin(), ring.end(), 0U);
  std::vector<std::array<uint32_t, 3>> triangles;
  triangles.reserve(corners.size() - 2);

  const auto corner = [&](std::size_t i) -> std::array<uint32_t, 3> {
    const std::size_t n = ring.size();
    return {ring[(i + n - 1) % n], ring[i % n], ring[(i + 1) % n]};
  };
  const auto turn_at = [&](std::size_t i) {
    const auto [a, b, c] = corner(i);
    return turn(points[a], points[b], points[c]);
  };
  const auto is_ear = [&](std::size_t i) {
    if (!(turn_at(i) > 0.0)) return false;
    const auto [a, b, c] = corner(i);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      // In a simple polygon only a corner that does not turn left can lie inside an ear.
      if (turn_at(k) <= 0.0 && inside(points[ring[k]], points[a], points[b], points[c])) {
        return false;
      }
    }
    return true;
  };

  std::size_t next = 1;
  while (ring.size() > 3) {
    std::size_t ear = next;
    std::size_t tried = 0;
    while (tried < ring.size() && !is_ear(ear % ring.size())) {
      ++ear;
      ++tried;
    }
    // No ear: the polygon crosses itself or has no area. Any corner will do.
    const std::size_t cut = ear % ring.size();
    triangles.push_back(corner(cut));
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(cut));
    next = cut;
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

}  // namespace trisect
