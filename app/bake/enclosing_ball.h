// A small ball that contains given balls.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace trisect {

struct Ball {
  glm::dvec3 center{0.0};
  double radius = 0.0;
};

// A ball that contains all of `balls`, of which there must be one at least: the core-set iteration
// of Badoiu & Clarkson 2003, "Smaller core-sets for balls". Its radius is at most some percent
// larger than the smallest one (2% in the tests' cases). It contains the balls up to the rounding
// of a distance in double precision. All numbers must be finite. Pure and deterministic, but the
// result depends on the order of the balls.
Ball enclosing_ball(std::span<const Ball> balls);

}  // namespace trisect
