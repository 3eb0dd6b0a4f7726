// Balls that contain balls.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace trisect {

struct Ball {
  glm::dvec3 center{0.0};
  double radius = 0.0;
};

// A ball that contains all of `balls` (one or more), a little larger than the smallest (2% in the
// tests' cases): the core-set iteration of Badoiu & Clarkson 2003. Deterministic; contains them up
// to the rounding of a distance.
Ball enclosing_ball(std::span<const Ball> balls);

}  // namespace trisect
