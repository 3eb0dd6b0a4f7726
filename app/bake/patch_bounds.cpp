#include "app/bake/patch_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "app/surface/patch_range.h"
#include "app/surface/sphere_range.h"

namespace trisect {
namespace {

using glm::dvec3;

std::vector<Ball> flat_balls(const Patch& patch) {
  return {{patch.P[0], 0.0}, {patch.P[1], 0.0}, {patch.P[2], 0.0}};
}

// The control points of the cubic Bezier triangle that phong is in the normal shell.
std::vector<Ball> control_points(const Patch& patch, double alpha) {
  std::vector<Ball> points = flat_balls(patch);
  dvec3 middle = (patch.P[0] + patch.P[1] + patch.P[2]) * 2.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const double s = alpha * glm::dot(patch.P[j] - patch.P[i], patch.N[j] - patch.N[i]);
    points.push_back({(patch.P[i] * 2.0 + patch.P[j] + patch.N[i] * s) / 3.0, 0.0});
    points.push_back({(patch.P[j] * 2.0 + patch.P[i] + patch.N[j] * s) / 3.0, 0.0});
    middle += patch.N[k] * s;
  }
  points.push_back({middle / 6.0, 0.0});
  return points;
}

std::vector<Ball> phong_balls(const Patch& patch, double alpha) {
  std::vector<Ball> balls = flat_balls(patch);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const dvec3 edge = patch.P[j] - patch.P[i];
    const dvec3 V =
        patch.N[j] * glm::dot(edge, patch.N[j]) - patch.N[i] * glm::dot(edge, patch.N[i]);
    const dvec3 quarter = V * (alpha / 4.0);
    balls.push_back({(patch.P[i] + patch.P[j]) / 2.0 + quarter, glm::length(quarter)});
  }
  return balls;
}

// Points whose hull contains the sphere surface over 4^level parts of the triangle; none where a
// part has no bound.
std::vector<Ball> sphere_points(const Patch& patch, int level) {
  std::vector<Part> parts{kWholeTriangle};
  for (int k = 0; k < level; ++k) {
    std::vector<Part> finer;
    for (const Part& part : parts) {
      for (const Part& piece : quarter(part)) finer.push_back(piece);
    }
    parts = std::move(finer);
  }
  std::vector<Ball> points;
  for (const Part& part : parts) {
    const PartCorners corners = corners_of(patch, part);
    const std::optional<Interval> sigma = sphere_sigma_range(patch, part, corners);
    if (!sigma) return {};
    for (std::size_t k = 0; k < 3; ++k) {
      points.push_back({corners.T[k] + corners.D[k] * sigma->lo, 0.0});
      points.push_back({corners.T[k] + corners.D[k] * sigma->hi, 0.0});
    }
  }
  return points;
}

Ball bound_sphere_surface(const Patch& patch) {
  const Ball base = enclosing_ball(flat_balls(patch));
  // No point is displaced by more than the longest edge.
  Ball best{base.center, base.radius + patch.longest};
  for (const dvec3& D : patch.D) {
    // An infinite direction, or one against the face normal, bounds nothing below.
    if (!std::isfinite(glm::dot(D, D))) return best;
  }
  constexpr double tight = 1.1;
  constexpr int levels = 3;
  for (int level = 0; level <= levels && best.radius > tight * base.radius; ++level) {
    const std::vector<Ball> points = sphere_points(patch, level);
    if (points.empty()) continue;
    const Ball ball = enclosing_ball(points);
    if (ball.radius < best.radius) best = ball;
  }
  return best;
}

}  // namespace

Ball bound_patch(const SurfaceChoice& choice, const Triangle& tri) {
  const Patch patch = patch_of(choice.shell, tri);
  const auto points = [&] {
    if (choice.surface == SURFACE_FLAT) return flat_balls(patch);
    return choice.shell == SHELL_HEIGHT ? phong_balls(patch, choice.alpha)
                                        : control_points(patch, choice.alpha);
  };
  Ball ball =
      choice.surface == SURFACE_SPHERE ? bound_sphere_surface(patch) : enclosing_ball(points());
  ball.radius += kBoundSlack * (ball.radius + glm::length(ball.center));
  return ball;
}

}  // namespace trisect
