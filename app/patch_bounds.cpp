#include "app/patch_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "app/interval.h"

namespace trisect {
namespace {

using glm::dvec3;

// The baked numbers in double precision.
struct Patch {
  std::array<dvec3, 3> P;
  std::array<dvec3, 3> N;
  std::array<dvec3, 3> D;     // the shell's directions
  std::array<dvec3, 3> data;  // curvatures and angle
  double longest;
};

Patch patch_of(uint shell, const Triangle& tri) {
  Patch patch{};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    patch.P[k] = dvec3(tri.Position[i]);
    patch.N[k] = dvec3(tri.Normal[i]);
    patch.D[k] =
        shell == SHELL_HEIGHT ? patch.N[k] / static_cast<double>(tri.NormDot[i]) : patch.N[k];
    patch.data[k] = dvec3(tri.VertexData[i]);
  }
  patch.longest = static_cast<double>(tri.TriNormal.w);
  return patch;
}

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

// A part of the triangle: the weights of its corners.
using Part = std::array<dvec3, 3>;

dvec3 weigh(const dvec3& w, const std::array<dvec3, 3>& p) {
  return p[0] * w.x + p[1] * w.y + p[2] * w.z;
}

// Range of sum_k w_k a_k . b over a part.
Interval linear_range(const std::array<dvec3, 3>& a, const dvec3& b) {
  return hull(hull(dot(a[0], b), dot(a[1], b)), dot(a[2], b));
}

// Range of (sum_k w_k a_k) . (sum_k w_k b_k) over a part: the hull of its Bernstein coefficients.
Interval product_range(const std::array<dvec3, 3>& a, const std::array<dvec3, 3>& b) {
  Interval range = dot(a[0], b[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    range = hull(range, dot(a[i], b[i]));
    range = hull(range, (dot(a[i], b[j]) + dot(a[j], b[i])) * 0.5);
  }
  return range;
}

// Range of the curvature at vertex i, seen from which a convex part spans the angles of its
// corners.
Interval curvature_range(const Patch& patch, std::size_t i, const std::array<dvec3, 3>& T) {
  const dvec3& b = patch.P[i == 2 ? 1 : 2];
  double lowest = 1.0;
  double highest = 0.0;
  for (const dvec3& corner : T) {
    const dvec3 x = corner - patch.P[i];
    if (x == dvec3(0.0)) continue;
    const dvec3 e = b - patch.P[i];
    const double beta = std::atan2(glm::length(glm::cross(x, e)), glm::dot(x, e)) / patch.data[i].z;
    lowest = std::min(lowest, beta);
    highest = std::max(highest, beta);
  }
  // The angle is exact to some ten units in the last place of pi.
  constexpr double rounding = 1e-14;
  const double slack = rounding / patch.data[i].z;
  const Interval beta(std::clamp(lowest - slack, 0.0, 1.0), std::clamp(highest + slack, 0.0, 1.0));
  return patch.data[i].y + beta * (Interval(patch.data[i].x) - patch.data[i].y);
}

// Range of s_i over a part, in units of D, or nothing where it is not bounded by this means.
std::optional<Interval> height_range(const Patch& patch, std::size_t i,
                                     const std::array<dvec3, 3>& T, const std::array<dvec3, 3>& D) {
  const std::array<dvec3, 3> x{T[0] - patch.P[i], T[1] - patch.P[i], T[2] - patch.P[i]};
  const Interval c = curvature_range(patch, i, T);
  const Interval A = c * product_range(D, D);
  const Interval B = c * product_range(x, D) + linear_range(D, patch.N[i]);
  const Interval C = c * product_range(x, x) + Interval(2.0) * linear_range(x, patch.N[i]);
  if (!(B.lo > 0.0)) return std::nullopt;
  const Interval s = -divide_by_positive(C, B + root(square(B) - A * C));
  // A root past the limit is drawn back toward 0.
  const double limit = patch.longest / root(product_range(D, D)).hi * (1.0 - 1e-14);
  return s.hi > limit || s.lo < -limit ? hull(s, 0.0) : s;
}

// Range of sigma = sum w_i s_i over a part.
std::optional<Interval> sigma_range(const Patch& patch, const Part& part,
                                    const std::array<dvec3, 3>& T, const std::array<dvec3, 3>& D) {
  Interval sigma(0.0);
  for (int i = 0; i < 3; ++i) {
    const auto s = height_range(patch, static_cast<std::size_t>(i), T, D);
    if (!s) return std::nullopt;
    const auto [lo, hi] = std::minmax({part[0][i], part[1][i], part[2][i]});
    sigma = sigma + Interval(lo, hi) * *s;
  }
  return sigma;
}

std::array<Part, 4> quarter(const Part& part) {
  const dvec3 a = (part[1] + part[2]) * 0.5;
  const dvec3 b = (part[2] + part[0]) * 0.5;
  const dvec3 c = (part[0] + part[1]) * 0.5;
  return {Part{part[0], c, b}, Part{c, part[1], a}, Part{b, a, part[2]}, Part{a, b, c}};
}

// Points whose hull contains the sphere surface over 4^level parts of the triangle; none where a
// part has no bound.
std::vector<Ball> sphere_points(const Patch& patch, int level) {
  std::vector<Part> parts{{dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}};
  for (int k = 0; k < level; ++k) {
    std::vector<Part> finer;
    for (const Part& part : parts) {
      for (const Part& piece : quarter(part)) finer.push_back(piece);
    }
    parts = std::move(finer);
  }
  std::vector<Ball> points;
  for (const Part& part : parts) {
    std::array<dvec3, 3> T{};
    std::array<dvec3, 3> D{};
    for (std::size_t k = 0; k < 3; ++k) {
      T[k] = weigh(part[k], patch.P);
      D[k] = weigh(part[k], patch.D);
    }
    const std::optional<Interval> sigma = sigma_range(patch, part, T, D);
    if (!sigma) return {};
    for (std::size_t k = 0; k < 3; ++k) {
      points.push_back({T[k] + D[k] * sigma->lo, 0.0});
      points.push_back({T[k] + D[k] * sigma->hi, 0.0});
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
