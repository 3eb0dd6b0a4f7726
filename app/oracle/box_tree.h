// A bounding volume hierarchy in double precision, to find the boxes that a ray may meet.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace trisect {

struct Box {
  glm::dvec3 lo;
  glm::dvec3 hi;
};

// Of a ball: its centre and radius, whose sign does not count.
Box box_around_ball(const glm::dvec4& ball);

// Not changed after construction: safe to use from several threads.
class BoxTree {
 public:
  BoxTree() = default;
  // Boxes may be infinite, but must not be NaN. Keeps no reference.
  explicit BoxTree(std::span<const Box> boxes);

  // Replaces `found` by the indices of the boxes that come within `margin` of the ray, of unit
  // direction, between these distances along it, in no particular order. There may be some more,
  // but rounding leaves out none.
  void meet(const glm::dvec3& origin, const glm::dvec3& direction, double t_min, double t_max,
            double margin, std::vector<uint32_t>& found) const;

 private:
  struct Node {
    Box box;
    uint32_t right;  // index of the right child, 0 for a leaf; the left child follows its parent
    uint32_t leaf;   // index of a leaf's box
  };
  void build(std::span<const Box> boxes, std::span<uint32_t> indices);

  std::vector<Node> nodes_;
};

}  // namespace trisect
