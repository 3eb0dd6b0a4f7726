#include "app/bake/enclosing_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trisect {
namespace {

double farthest_distance(const glm::dvec3& center, const Ball& ball) {
  return glm::distance(center, ball.center) + ball.radius;
}

// The ball that reaches farthest from a centre, the first one if there are several, and how far.
struct Farthest {
  const Ball* ball;
  double distance;
};

Farthest farthest(const glm::dvec3& center, std::span<const Ball> balls, bool are_points) {
  if (are_points) {
    // Squares of distances compare alike and save a square root for each point.
    Farthest far{balls.data(), -1.0};
    for (const Ball& ball : balls) {
      const glm::dvec3 away = center - ball.center;
      const double square = glm::dot(away, away);
      if (square > far.distance) far = {&ball, square};
    }
    return {far.ball, std::sqrt(far.distance)};
  }
  Farthest far{balls.data(), farthest_distance(center, balls[0])};
  for (const Ball& ball : balls.subspan(1)) {
    const double distance = farthest_distance(center, ball);
    if (distance > far.distance) far = {&ball, distance};
  }
  return far;
}

}  // namespace

Ball enclosing_ball(std::span<const Ball> balls) {
  glm::dvec3 center(0.0);
  for (const Ball& ball : balls) center += ball.center / static_cast<double>(balls.size());
  Ball best{center, std::numeric_limits<double>::infinity()};
  // After k steps the centre is at most 1 / sqrt(k) of the smallest ball's radius from that one's
  // (Badoiu & Clarkson); for the few points of a patch it is much nearer.
  constexpr int steps = 32;
  const bool are_points =
      std::all_of(balls.begin(), balls.end(), [](const Ball& ball) { return ball.radius == 0.0; });
  for (int k = 1; k <= steps; ++k) {
    const auto [ball, radius] = farthest(center, balls, are_points);
    const Ball& far = *ball;
    if (radius < best.radius) best = {center, radius};
    const double distance = glm::distance(center, far.center);
    if (distance == 0.0) break;
    // Step toward the point of that ball that is farthest from the centre.
    const glm::dvec3 point = far.center + (far.center - center) * (far.radius / distance);
    center += (point - center) / static_cast<double>(k + 1);
  }
  return best;
}

}  // namespace trisect
