#include "app/mesh/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

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

// The corners of a polygon in its plane, of which ears are cut off.
class Ring {
 public:
  explicit Ring(std::vector<glm::dvec2> points)
      : points_(std::move(points)),
        before_(points_.size()),
        after_(points_.size()),
        blocks_(points_.size(), false) {
    const auto n = static_cast<uint32_t>(points_.size());
    for (uint32_t i = 0; i < n; ++i) {
      before_[i] = (i + n - 1) % n;
      after_[i] = (i + 1) % n;
    }
    least_ = largest_ = points_[0];
    for (const glm::dvec2& p : points_) {
      least_ = glm::min(least_, p);
      largest_ = glm::max(largest_, p);
    }
    uint32_t blocking = 0;
    for (uint32_t i = 0; i < n; ++i) blocking += turn_at(i) > 0.0 ? 0 : 1;
    // About one blocking corner in a cell.
    cells_across_ = std::max(1U, static_cast<uint32_t>(std::sqrt(blocking)));
    cells_.resize(std::size_t{cells_across_} * cells_across_);
    for (uint32_t i = 0; i < n; ++i) note_turn(i);
  }

  [[nodiscard]] std::array<uint32_t, 3> corner(uint32_t i) const {
    return {before_[i], i, after_[i]};
  }
  [[nodiscard]] uint32_t after(uint32_t i) const { return after_[i]; }

  // Whether the triangle at corner i lies within the polygon and can be cut off.
  [[nodiscard]] bool is_ear(uint32_t i) const {
    if (!(turn_at(i) > 0.0)) return false;
    const glm::dvec2& a = points_[before_[i]];
    const glm::dvec2& b = points_[i];
    const glm::dvec2& c = points_[after_[i]];
    const glm::uvec2 first = cell_of(glm::min(glm::min(a, b), c));
    const glm::uvec2 last = cell_of(glm::max(glm::max(a, b), c));
    for (uint32_t y = first.y; y <= last.y; ++y) {
      for (uint32_t x = first.x; x <= last.x; ++x) {
        for (const uint32_t k : cells_[std::size_t{y} * cells_across_ + x]) {
          if (blocks_[k] && inside(points_[k], a, b, c)) return false;
        }
      }
    }
    return true;
  }

  void cut(uint32_t i) {
    blocks_[i] = false;
    after_[before_[i]] = after_[i];
    before_[after_[i]] = before_[i];
    note_turn(before_[i]);
    note_turn(after_[i]);
  }

 private:
  [[nodiscard]] double turn_at(uint32_t i) const {
    return turn(points_[before_[i]], points_[i], points_[after_[i]]);
  }

  [[nodiscard]] glm::uvec2 cell_of(const glm::dvec2& p) const {
    const glm::dvec2 size = largest_ - least_;
    glm::uvec2 cell(0);
    for (int k = 0; k < 2; ++k) {
      // Written so that a NaN is in the first cell.
      const double at = size[k] > 0.0 ? (p[k] - least_[k]) / size[k] * cells_across_ : 0.0;
      if (at >= 1.0) {
        cell[k] = std::min(static_cast<uint32_t>(std::min(at, 1e9)), cells_across_ - 1);
      }
    }
    return cell;
  }

  // In a simple polygon only a corner that does not turn left can lie inside an ear.
  void note_turn(uint32_t i) {
    const bool blocked = blocks_[i];
    blocks_[i] = !(turn_at(i) > 0.0);
    if (!blocks_[i] || blocked) return;
    const glm::uvec2 cell = cell_of(points_[i]);
    cells_[std::size_t{cell.y} * cells_across_ + cell.x].push_back(i);
  }

  std::vector<glm::dvec2> points_;
  std::vector<uint32_t> before_;
  std::vector<uint32_t> after_;
  std::vector<bool> blocks_;  // corners that may lie inside an ear
  glm::dvec2 least_;
  glm::dvec2 largest_;
  uint32_t cells_across_ = 1;
  std::vector<std::vector<uint32_t>> cells_;  // the blocking corners, by their places
};

}  // namespace

std::vector<std::array<uint32_t, 3>> triangulate(std::span<const glm::dvec3> corners) {
  Ring ring(project(corners));
  std::vector<std::array<uint32_t, 3>> triangles;
  triangles.reserve(corners.size() - 2);
  uint32_t next = 1;
  for (std::size_t left = corners.size(); left > 3; --left) {
    uint32_t ear = next;
    for (std::size_t tried = 0; tried < left && !ring.is_ear(ear); ++tried) ear = ring.after(ear);
    // No ear, and once around: the polygon crosses itself or has no area. Any corner will do.
    triangles.push_back(ring.corner(ear));
    next = ring.after(ear);
    ring.cut(ear);
  }
  // From the first of those that are left.
  const std::array<uint32_t, 3> last = ring.corner(next);
  const uint32_t first = std::min({last[0], last[1], last[2]});
  triangles.push_back({first, ring.after(first), ring.after(ring.after(first))});
  return triangles;
}

}  // namespace trisect
