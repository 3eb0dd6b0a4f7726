#include "app/oracle/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trisect {
namespace {

using glm::dvec3;

Box around(std::span<const Box> boxes, std::span<const uint32_t> indices) {
  Box all = boxes[indices[0]];
  for (const uint32_t index : indices) {
    all.lo = glm::min(all.lo, boxes[index].lo);
    all.hi = glm::max(all.hi, boxes[index].hi);
  }
  return all;
}

// The middle of an infinite box is taken for 0, so that middles can be sorted.
double middle(const Box& box, int axis) {
  const double m = box.lo[axis] * 0.5 + box.hi[axis] * 0.5;
  return std::isfinite(m) ? m : 0.0;
}

// The slab test (Kay & Kajiya 1986, "Ray tracing complex scenes"). `margin` includes the rounding
// of the coordinates.
bool meets(const Box& box, const dvec3& origin, const dvec3& direction, double t_min, double t_max,
           double margin) {
  for (int k = 0; k < 3; ++k) {
    const double lo = box.lo[k] - margin - origin[k];
    const double hi = box.hi[k] + margin - origin[k];
    // Parallel to the slab as far as rounding can tell, and the quotients might overflow.
    if (std::abs(direction[k]) < 1e-200) {
      if (lo > 0.0 || hi < 0.0) return false;
      continue;
    }
    const double a = lo / direction[k];
    const double b = hi / direction[k];
    // For the rounding of the quotients.
    constexpr double relative = 1e-15;
    const double near = std::min(a, b);
    const double far = std::max(a, b);
    t_min = std::max(t_min, near - std::abs(near) * relative);
    t_max = std::min(t_max, far + std::abs(far) * relative);
  }
  return t_min <= t_max;
}

}  // namespace

Box box_around_ball(const glm::dvec4& ball) {
  const dvec3 center(ball);
  const dvec3 radius(std::abs(ball.w));
  return {center - radius, center + radius};
}

BoxTree::BoxTree(std::span<const Box> boxes) {
  std::vector<uint32_t> indices(boxes.size());
  std::iota(indices.begin(), indices.end(), 0U);
  if (!boxes.empty()) build(boxes, indices);
}

void BoxTree::build(std::span<const Box> boxes, std::span<uint32_t> indices) {
  const std::size_t self = nodes_.size();
  nodes_.push_back({around(boxes, indices), 0, indices[0]});
  if (indices.size() == 1) return;
  // Split at the median along the axis on which the middles spread farthest.
  dvec3 lo(std::numeric_limits<double>::infinity());
  dvec3 hi = -lo;
  for (const uint32_t index : indices) {
    const Box& box = boxes[index];
    const dvec3 m(middle(box, 0), middle(box, 1), middle(box, 2));
    lo = glm::min(lo, m);
    hi = glm::max(hi, m);
  }
  const dvec3 spread = hi - lo;
  int axis = spread.y > spread.x ? 1 : 0;
  if (spread.z > spread[axis]) axis = 2;
  const std::size_t half = indices.size() / 2;
  std::nth_element(
      indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(half), indices.end(),
      [&](uint32_t a, uint32_t b) { return middle(boxes[a], axis) < middle(boxes[b], axis); });
  build(boxes, indices.first(half));
  nodes_[self].right = static_cast<uint32_t>(nodes_.size());
  build(boxes, indices.subspan(half));
}

void BoxTree::meet(const dvec3& origin, const dvec3& direction, double t_min, double t_max,
                   double margin, std::vector<uint32_t>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  const Box& all = nodes_[0].box;
  const double magnitude =
      std::max({glm::length(origin), glm::length(all.lo), glm::length(all.hi)});
  if (std::isfinite(magnitude)) margin += 1e-14 * magnitude;
  // Median splits of 2^32 boxes are 32 levels deep; one sibling waits at each level.
  std::array<uint32_t, 64> waiting{};
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const uint32_t index = waiting[--count];
    const Node& node = nodes_[index];
    if (!meets(node.box, origin, direction, t_min, t_max, margin)) continue;
    if (node.right == 0) {
      found.push_back(node.leaf);
      continue;
    }
    waiting[count++] = node.right;
    waiting[count++] = index + 1;
  }
}

}  // namespace trisect
