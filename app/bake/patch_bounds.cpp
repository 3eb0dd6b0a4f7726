#include "app/bake/patch_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "app/surface/control_net.h"
#include "app/surface/patch_range.h"
#include "app/surface/sphere_range.h"
#include "app/surface/surface_double.h"

namespace trisect {
namespace {

using glm::dvec3;

std::vector<Ball> flat_balls(const Patch& patch) {
  return {{patch.P[0], 0.0}, {patch.P[1], 0.0}, {patch.P[2], 0.0}};
}

// For phong in the normal shell.
std::vector<Ball> cubic_balls(const Patch& patch, double alpha) {
  std::vector<Ball> points;
  for (const dvec3& point : control_points(patch, phong_quadratic(patch, alpha), kWholeTriangle)) {
    points.push_back({point, 0.0});
  }
  return points;
}

// For phong in the height shell.
std::vector<Ball> thales_balls(const Patch& patch, double alpha) {
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

// Points whose hull contains the sphere surface, from the ranges of sigma over 4^level
// sub-triangles. None if sigma has no known range over one of them.
std::vector<Ball> sphere_points(const Patch& patch, int level) {
  std::vector<in_double::SubTriangle> sub_triangles{kWholeTriangle};
  for (int k = 0; k < level; ++k) {
    std::vector<in_double::SubTriangle> finer;
    for (const in_double::SubTriangle& coarse : sub_triangles) {
      for (const in_double::SubTriangle& fine : quarter(coarse)) finer.push_back(fine);
    }
    sub_triangles = std::move(finer);
  }
  std::vector<Ball> points;
  for (const in_double::SubTriangle& sub_triangle : sub_triangles) {
    const CornerWeights weights = corner_weights(sub_triangle);
    const PatchCorners corners = corners_of(patch, weights);
    const std::optional<Interval> sigma = sphere_sigma_range(patch, weights, corners);
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
  // sphere_height displaces no point by more than so many times its distance from a vertex.
  Ball best{base.center, base.radius + in_double::HIGHEST * patch.longest};
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
    return choice.shell == SHELL_HEIGHT ? thales_balls(patch, choice.alpha)
                                        : cubic_balls(patch, choice.alpha);
  };
  Ball ball =
      choice.surface == SURFACE_SPHERE ? bound_sphere_surface(patch) : enclosing_ball(points());
  ball.radius += kBoundSlack * (ball.radius + glm::length(ball.center));
  return ball;
}

}  // namespace trisect
