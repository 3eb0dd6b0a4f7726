#include "app/mesh/polygon.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <deque>
#include <numeric>
#include <utility>

namespace trisect {
namespace {

// More corners are cut by LargeRing. Polygons of models hardly have as many.
constexpr std::size_t kMostOfRing = 512;
constexpr uint64_t kStepsPerLevel = 256;

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

bool blocks(const glm::dvec2& before, const glm::dvec2& p, const glm::dvec2& after) {
  return !(turn(before, p, after) > 0.0);
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

// Points of which some are marked, by a tree of boxes: each has at most kInLeaf points, or two
// boxes of half of its points.
class PointTree {
 public:
  explicit PointTree(const std::vector<glm::dvec2>& points)
      : points_(points), order_(points.size()), leaf_of_(points.size()), marked_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    boxes_.reserve(points.size());
    add_box(0, static_cast<uint32_t>(points.size()), 0);
  }

  [[nodiscard]] bool is_marked(uint32_t i) const { return marked_[i]; }

  void mark(uint32_t i, bool is_marked) {
    if (marked_[i] == is_marked) return;
    marked_[i] = is_marked;
    uint32_t box = leaf_of_[i];
    while (true) {
      boxes_[box].marked += is_marked ? 1 : -1;
      if (box == 0) break;
      box = boxes_[box].above;
    }
  }

  // A marked point inside the triangle, kNone without one. Adds the boxes that it looked at to
  // `steps`.
  [[nodiscard]] uint32_t marked_inside(const glm::dvec2& a, const glm::dvec2& b,
                                       const glm::dvec2& c, uint64_t& steps) const {
    std::array<uint32_t, 64> waiting{};
    std::size_t count = 1;
    while (count > 0) {
      const Box& box = boxes_[waiting[--count]];
      ++steps;
      if (box.marked == 0 || is_beside(box, a, b, c)) continue;
      if (box.halves != 0) {
        waiting[count++] = box.halves;
        waiting[count++] = box.second;
        continue;
      }
      for (uint32_t k = box.begin; k < box.end; ++k) {
        const uint32_t i = order_[k];
        if (marked_[i] && inside(points_[i], a, b, c)) return i;
      }
    }
    return kNone;
  }

  static constexpr uint32_t kNone = 0xffffffffU;

 private:
  static constexpr uint32_t kInLeaf = 8;

  struct Box {
    glm::dvec2 low;
    glm::dvec2 high;
    uint32_t begin;  // in order_
    uint32_t end;
    uint32_t above;
    uint32_t halves = 0;  // the first of the two boxes, 0 without them
    uint32_t second = 0;
    int marked = 0;  // points of it
  };

  uint32_t add_box(uint32_t begin, uint32_t end, uint32_t above) {
    const auto index = static_cast<uint32_t>(boxes_.size());
    Box box{points_[order_[begin]], points_[order_[begin]], begin, end, above};
    for (uint32_t k = begin; k < end; ++k) {
      box.low = glm::min(box.low, points_[order_[k]]);
      box.high = glm::max(box.high, points_[order_[k]]);
    }
    boxes_.push_back(box);
    if (end - begin <= kInLeaf) {
      for (uint32_t k = begin; k < end; ++k) leaf_of_[order_[k]] = index;
      return index;
    }
    const glm::dvec2 size = box.high - box.low;
    const int axis = size.x >= size.y ? 0 : 1;
    const uint32_t middle = begin + (end - begin) / 2;
    const auto at = [&](uint32_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](uint32_t i, uint32_t k) { return points_[i][axis] < points_[k][axis]; });
    const uint32_t halves = add_box(begin, middle, index);
    const uint32_t second = add_box(middle, end, index);
    boxes_[index].halves = halves;
    boxes_[index].second = second;
    return index;
  }

  // Whether the box is outside of the triangle by one of its sides, or by one of the box's. Rounds
  // as inside() does: turn() grows or falls with each coordinate, also rounded.
  static bool is_beside(const Box& box, const glm::dvec2& a, const glm::dvec2& b,
                        const glm::dvec2& c) {
    const glm::dvec2 low = glm::min(glm::min(a, b), c);
    const glm::dvec2 high = glm::max(glm::max(a, b), c);
    if (box.low.x > high.x || box.low.y > high.y || box.high.x < low.x || box.high.y < low.y) {
      return true;
    }
    // The corner of the box that is farthest to the left of a side.
    const auto is_right_of = [&](const glm::dvec2& from, const glm::dvec2& to) {
      const glm::dvec2 leftmost(to.y > from.y ? box.low.x : box.high.x,
                                to.x > from.x ? box.high.y : box.low.y);
      return turn(from, to, leftmost) < 0.0;
    };
    return is_right_of(a, b) || is_right_of(b, c) || is_right_of(c, a);
  }

  const std::vector<glm::dvec2>& points_;
  std::vector<uint32_t> order_;
  std::vector<uint32_t> leaf_of_;
  std::vector<bool> marked_;
  std::vector<Box> boxes_;
};

// Cuts the ears of a polygon of many corners, each as soon as it is known to be one: a corner waits
// for what keeps it from being an ear, and is not looked at before that has changed.
class LargeRing {
 public:
  explicit LargeRing(std::vector<glm::dvec2> points)
      : points_(std::move(points)),
        tree_(points_),
        before_(points_.size()),
        after_(points_.size()),
        is_cut_(points_.size(), false),
        is_queued_(points_.size(), false),
        waiting_(points_.size()) {
    const auto n = static_cast<uint32_t>(points_.size());
    for (uint32_t i = 0; i < n; ++i) {
      before_[i] = (i + n - 1) % n;
      after_[i] = (i + 1) % n;
    }
    for (uint32_t i = 0; i < n; ++i) tree_.mark(i, blocks_at(i));
    for (uint32_t i = 0; i < n; ++i) look_at(i);
  }

  std::vector<std::array<uint32_t, 3>> cut(uint64_t& steps) {
    std::vector<std::array<uint32_t, 3>> triangles;
    triangles.reserve(points_.size() - 2);
    uint32_t any = 0;  // a corner that is left
    for (std::size_t left = points_.size(); left > 2; --left) {
      uint32_t ear = next_ear(steps);
      if (ear == PointTree::kNone) ear = any;
      triangles.push_back({before_[ear], ear, after_[ear]});
      any = after_[ear];
      remove(ear);
    }
    return triangles;
  }

 private:
  [[nodiscard]] bool blocks_at(uint32_t i) const {
    return blocks(points_[before_[i]], points_[i], points_[after_[i]]);
  }

  // The next corner that is an ear; kNone if there is none: the polygon crosses itself or has no
  // area.
  uint32_t next_ear(uint64_t& steps) {
    while (!queue_.empty()) {
      const uint32_t i = queue_.front();
      queue_.pop_front();
      is_queued_[i] = false;
      ++steps;
      if (is_cut_[i] || tree_.is_marked(i)) continue;
      if (steps > most_steps_) return i;
      const uint32_t other =
          tree_.marked_inside(points_[before_[i]], points_[i], points_[after_[i]], steps);
      if (other == PointTree::kNone) return i;
      waiting_[other].push_back(i);
    }
    return PointTree::kNone;
  }

  void look_at(uint32_t i) {
    if (is_cut_[i] || is_queued_[i] || tree_.is_marked(i)) return;
    is_queued_[i] = true;
    queue_.push_back(i);
  }

  void remove(uint32_t i) {
    is_cut_[i] = true;
    after_[before_[i]] = after_[i];
    before_[after_[i]] = before_[i];
    note_blocking(i, false);
    for (const uint32_t next : {before_[i], after_[i]}) {
      note_blocking(next, blocks_at(next));
      look_at(next);
    }
  }

  // Those that wait for a corner are looked at when it no longer blocks.
  void note_blocking(uint32_t i, bool blocks) {
    tree_.mark(i, blocks);
    if (blocks) return;
    for (const uint32_t other : std::exchange(waiting_[i], {})) look_at(other);
  }

  std::vector<glm::dvec2> points_;
  PointTree tree_;  // marks the corners that may lie inside an ear
  std::vector<uint32_t> before_;
  std::vector<uint32_t> after_;
  std::vector<bool> is_cut_;
  std::vector<bool> is_queued_;
  std::deque<uint32_t> queue_;  // corners that may be ears
  std::vector<std::vector<uint32_t>> waiting_;
  uint64_t most_steps_ = most_triangulation_steps(points_.size());
};

}  // namespace

uint64_t most_triangulation_steps(std::size_t corners) {
  return kStepsPerLevel * corners * static_cast<uint64_t>(std::bit_width(corners));
}

std::vector<std::array<uint32_t, 3>> triangulate(std::span<const glm::dvec3> corners,
                                                 uint64_t* steps) {
  uint64_t counted = 0;
  if (corners.size() > kMostOfRing) {
    std::vector<std::array<uint32_t, 3>> triangles = LargeRing(project(corners)).cut(counted);
    if (steps != nullptr) *steps = counted;
    return triangles;
  }
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
