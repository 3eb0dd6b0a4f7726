#include "app/bake/enclosing_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trisect {
namespace {

double farthest_distance(const glm::dvec3& center, const Ball& ball) {
  return glm::distance(center, ball.center) + ball.radius;
}

// The first of the balls that reach farthest from the centre, and how far.
struct Farthest {
  const Ball* ball;
  double farthest_distance;
};

Farthest farthest(const glm::dvec3& center, std::span<const Ball> balls, bool are_points) {
  if (are_points) {
    // One root is enough.
    Farthest far{balls.data(), -1.0};
    for (const Ball& ball : balls) {
      const glm::dvec3 away = center - ball.center;
      const double square = glm::dot(away, away);
      if (square > far.farthest_distance) far = {&ball, square};
    }
    return {far.ball, std::sqrt(far.farthest_distance)};
  }
  Farthest far{balls.data(), farthest_distance(center, balls[0])};
  for (const Ball& ball : balls.subspan(1)) {
    const double distance = farthest_distance(center, ball);
    if (distance > far.farthest_distance) far = {&ball, distance};
  }
  return far;
}

}  // namespace

Ball enclosing_ball(std::span<const Ball> balls) {
  glm::dvec3 center(0.0);
  for (const Ball& ball : balls) center += ball.center / static_cast<double>(balls.size());
  Ball best{center, std::numeric_limits<double>::infinity()};
  // After k steps the excess is at most of the order of 1/k; on the few points here it is far less.
  constexpr int steps = 32;
  const bool are_points =
      std::all_of(balls.begin(), balls.end(), [](const Ball& ball) { return ball.radius == 0.0; });
  for (int k = 1; k <= steps; ++k) {
    const auto [ball, radius] = farthest(center, balls, are_points);
    const Ball& far = *ball;
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
