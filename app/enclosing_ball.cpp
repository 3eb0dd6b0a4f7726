#include "app/enclosing_ball.h"

#include <algorithm>
#include <limits>

namespace trisect {
namespace {

double reach(const glm::dvec3& center, const Ball& ball) {
  return glm::distance(center, ball.center) + ball.radius;
}

const Ball& farthest(const glm::dvec3& center, std::span<const Ball> balls) {
  return *std::max_element(balls.begin(), balls.end(), [&](const Ball& a, const Ball& b) {
    return reach(center, a) < reach(center, b);
  });
}

}  // namespace

Ball enclosing_ball(std::span<const Ball> balls) {
  glm::dvec3 center(0.0);
  for (const Ball& ball : balls) center += ball.center / static_cast<double>(balls.size());
  Ball best{center, std::numeric_limits<double>::infinity()};
  // After k steps the excess is at most of the order of 1/k; on the few points here it is far less.
  constexpr int steps = 32;
  for (int k = 1; k <= steps; ++k) {
    const Ball& far = farthest(center, balls);
    const double radius = reach(center, far);
    if (radius < best.radius) best = {center, radius};
    const double distance = glm::distance(center, far.center);
    if (distance == 0.0) break;
    // Toward the far ball's farthest point.
    const glm::dvec3 point = far.center + (far.center - center) * (far.radius / distance);
    center += (point - center) / static_cast<double>(k + 1);
  }
  return best;
}

}  // namespace trisect
