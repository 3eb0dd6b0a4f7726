// A tree of boxes, to find those that a ray may meet.
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

class BoxTree {
 public:
  BoxTree() = default;
  // Boxes may be infinite, but must not be NaN.
  explicit BoxTree(std::span<const Box> boxes);

  // The numbers of the boxes that come within `margin` of the ray between these distances, put into
  // `found`, in no order. A box is never left out for rounding. direction: of unit length.
  void meet(const glm::dvec3& origin, const glm::dvec3& direction, double t_min, double t_max,
            double margin, std::vector<uint32_t>& found) const;

 private:
  struct Node {
    Box box;
    uint32_t right;  // child; the left one follows its parent. 0: a leaf
    uint32_t leaf;   // number of the box
  };
  void build(std::span<const Box> boxes, std::span<uint32_t> numbers);

  std::vector<Node> nodes_;
};

}  // namespace trisect
