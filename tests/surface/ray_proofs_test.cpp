// What the robust solver takes for proven about a ray and a node (shaders/subpatch_bounds.glsl), in
// single precision, against the definitions in double precision. Where a bound can be reached the
// numbers are made to reach it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "app/bake/subpatch_bounds.h"
#include "app/surface/surface_double.h"
#include "app/surface/surface_float.h"
#include "app/surface/to_double.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec2;
using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

dvec3 in_cube(Random& random) {
  return {between(random, -1.0, 1.0), between(random, -1.0, 1.0), between(random, -1.0, 1.0)};
}

double sign(Random& random) {
  return random() % 2 == 0 ? 1.0 : -1.0;
}

double cross(const dvec2& a, const dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

double largest(const dvec2& a) {
  return std::max(std::abs(a.x), std::abs(a.y));
}

in_double::FramedPatch exactly(const in_float::FramedPatch& at) {
  return {dvec3(at.P0), dvec3(at.P1), dvec3(at.P2), dvec3(at.D0), dvec3(at.D1), dvec3(at.D2)};
}

std::array<dvec2, 10> points_of(const in_double::ControlNet& net) {
  return {net.b300, net.b030, net.b003, net.b210, net.b120,
          net.b021, net.b012, net.b102, net.b201, net.b111};
}

// The control point b with the least b x a.
dvec2 first_across(const std::array<dvec2, 10>& points, const dvec2& a) {
  return *std::ranges::min_element(points, {}, [&](const dvec2& b) { return cross(b, a); });
}

// Whether a line separates the hull of the points from the ray: if any does, one that is parallel
// to the line through two of them, or at right angles to one of them, does.
bool is_separated(const std::array<dvec2, 10>& points) {
  const auto by = [&](const dvec2& a) {
    return cross(first_across(points, a), a) > 0.0 || cross(first_across(points, -a), -a) > 0.0;
  };
  for (const dvec2& p : points) {
    if (by({-p.y, p.x})) return true;
    for (const dvec2& q : points) {
      if (by(q - p)) return true;
    }
  }
  return false;
}

// A ray that touches the hull of a node, or all but does, is never proven to miss it.
TEST(RayProofs, TheHullOverlapsWhatItTouches) {
  Random random(1);
  std::size_t touching = 0;
  for (int i = 0; i < 100000; ++i) {
    in_float::FramedPatch framed{vec3(in_cube(random)), vec3(in_cube(random)),
                                 vec3(in_cube(random)), vec3(in_cube(random)),
                                 vec3(in_cube(random)), vec3(in_cube(random))};
    const vec3 corner(0.3 * in_cube(random));
    const vec3 edge(0.3 * in_cube(random));
    in_float::SubTriangle node{vec3(0.0F), 1.0F};
    for (uint64_t level = random() % 4; level > 0; --level) {
      node = in_float::child(node, static_cast<uint>(random() % 4));
    }
    node = in_float::with_overlap(node);
    const auto exact_points = [&] {
      return points_of(in_double::control_net(exactly(framed), dvec3(corner), dvec3(edge),
                                              {dvec3(node.origin), node.size}));
    };
    // Moves it so that the ray touches the hull at a corner that is the first in one of the
    // solver's directions, but for what single precision rounds.
    const std::array<dvec2, 10> before = exact_points();
    const dvec2 u = before[1] - before[0];
    const dvec2 v = before[2] - before[0];
    const std::array<dvec2, 4> directions{u, v, v - u, {-u.y - v.y, u.x + v.x}};
    const vec3 shift(vec2(first_across(before, directions[random() % 4] * sign(random))), 0.0F);
    framed.P0 -= shift;
    framed.P1 -= shift;
    framed.P2 -= shift;
    const bool is_apart = is_separated(exact_points());
    // As position_tolerance() has it for a ray whose anchor is at the patch.
    const float tolerance =
        in_float::ROUNDINGS * std::max({in_float::length3(framed.P0), in_float::length3(framed.P1),
                                        in_float::length3(framed.P2)});
    const bool overlaps =
        in_float::hull_overlaps_ray(in_float::control_net(framed, corner, edge, node), tolerance);
    if (!is_apart) {
      ++touching;
      ASSERT_TRUE(overlaps) << i;
    }
  }
  EXPECT_GT(touching, 10000U);
}

// The components of b differ from those of the hull by the tolerance at most: a ray that is so near
// to it is not proven to miss it, one that is twice as far away is.
TEST(RayProofs, TheHullIsWidenedByItsTolerance) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    // A flat triangle, so that its hull is known.
    const vec2 p(in_cube(random));
    const vec2 u(in_cube(random));
    const vec2 v(in_cube(random));
    if (std::abs(in_float::cross2(u, v)) < 0.1F) continue;
    in_float::FramedPatch framed{vec3(p, 0.0F), vec3(p + u, 0.0F), vec3(p + v, 0.0F),
                                 vec3(0.0F),    vec3(0.0F),        vec3(0.0F)};
    const double tolerance = between(random, 1e-3, 1e-1);
    // Outward from the middle of an edge, until the box of the tolerance touches the edge.
    const std::array<dvec2, 3> corners{dvec2(p), dvec2(p + u), dvec2(p + v)};
    const std::size_t k = random() % 3;
    const dvec2 along = corners[(k + 1) % 3] - corners[k];
    dvec2 out(along.y, -along.x);
    if (glm::dot(out, corners[(k + 2) % 3] - corners[k]) > 0.0) out = -out;
    const double reach = (std::abs(out.x) + std::abs(out.y)) / glm::dot(out, out);
    for (const double times : {0.999, 2.0}) {
      const dvec2 ray =
          0.5 * (corners[k] + corners[(k + 1) % 3]) + out * (times * tolerance * reach);
      in_float::FramedPatch moved = framed;
      for (vec3* corner : {&moved.P0, &moved.P1, &moved.P2}) *corner -= vec3(vec2(ray), 0.0F);
      const bool overlaps = in_float::hull_overlaps_ray(
          in_float::control_net(moved, vec3(0.0F), vec3(0.0F), {vec3(0.0F), 1.0F}),
          static_cast<float>(tolerance));
      ASSERT_EQ(overlaps, times < 1.0) << i;
    }
  }
}

// |1 - J0^-1 J| in the matrix norm of the maximum norm for J = 3 (u, v) and J0 = 3 (u0, v0).
double exact_contraction(const dvec2& u0, const dvec2& v0, const dvec2& u, const dvec2& v) {
  const double area = cross(u0, v0);
  const dvec2 column_u = dvec2(cross(u, v0), cross(u0, u)) / area;
  const dvec2 column_v = dvec2(cross(v, v0), cross(u0, v)) / area;
  return std::max(std::abs(1.0 - column_u.x) + std::abs(column_v.x),
                  std::abs(column_u.y) + std::abs(1.0 - column_v.y));
}

// No tangents that occur are farther from their mean than the bound of the contraction test: not
// those of the net, nor those that differ from them by as much as the tangents' error allows.
TEST(RayProofs, TheContractionBoundHoldsForAllTangentsOfTheNode) {
  Random random(3);
  double nearest = 1e9;  // of the bound over what occurs, less 1
  for (int i = 0; i < 100000; ++i) {
    const dvec2 u0(in_cube(random));
    const dvec2 v0(in_cube(random));
    if (std::abs(cross(u0, v0)) < 0.1) continue;
    const double spread = 0.2 * between(random, 0.0, 1.0);
    std::array<vec2, 6> u;
    std::array<vec2, 6> v;
    for (std::size_t k = 0; k < 6; ++k) {
      u[k] = vec2(u0 + spread * dvec2(in_cube(random)));
      v[k] = vec2(v0 + spread * dvec2(in_cube(random)));
    }
    const double error = i % 2 == 0 ? 0.0 : between(random, 0.0, 0.1);
    const in_float::MeanJacobian mean = in_float::mean_jacobian(
        {u[0], u[1], u[2], u[3], u[4], u[5], v[0], v[1], v[2], v[3], v[4], v[5]},
        static_cast<float>(error));
    const dvec2 mean_u(mean.u);
    const dvec2 mean_v(mean.v);
    // The changes of u and v that change one row of J0^-1 J the most.
    const dvec2 first = error * glm::normalize(dvec2(-mean_v.y, mean_v.x));
    const dvec2 second = error * glm::normalize(dvec2(-mean_u.y, mean_u.x));
    double occurs = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
      for (const dvec2& e : {first, second}) {
        for (const double sign_u : {-1.0, 1.0}) {
          for (const double sign_v : {-1.0, 1.0}) {
            occurs = std::max(occurs, exact_contraction(mean_u, mean_v, dvec2(u[k]) + sign_u * e,
                                                        dvec2(v[k]) + sign_v * e));
          }
        }
      }
    }
    ASSERT_GE(mean.contraction_bound, occurs) << i;
    nearest = std::min(nearest, mean.contraction_bound / occurs - 1.0);
  }
  // It is no coarse bound.
  EXPECT_LT(nearest, 1e-4);
}

// A function with a root r in the node whose derivatives differ from J0 by k: no point excludes it.
TEST(RayProofs, NewtonDoesNotExcludeTheRootOfANode) {
  Random random(4);
  std::size_t excluded = 0;
  const int functions = 100000;
  for (int i = 0; i < functions; ++i) {
    // Points of the triangle; every second root on its border, which is nearest to being left out.
    const auto weights = [&](bool on_border) {
      dvec3 w(between(random, 0.0, 1.0), between(random, 0.0, 1.0), between(random, 0.0, 1.0));
      if (on_border) w[static_cast<int>(random() % 3)] = 0.0;
      return w / (w.x + w.y + w.z);
    };
    const dvec3 l = weights(false);
    const dvec3 r = weights(i % 2 == 0);
    const double k = between(random, 0.05, 0.95);
    // The mean of the Jacobian over the way from l to r moves J0^-1 f by k |r - l| at most.
    const auto moved = [&](const dvec3& root) {
      const dvec2 way(root.y - l.y, root.z - l.z);
      return -way + k * largest(way) * dvec2(sign(random), sign(random));
    };
    in_float::MeanJacobian mean{vec2(in_cube(random)), vec2(in_cube(random)), 0.0F,
                                static_cast<float>(k)};
    mean.area = in_float::cross2(mean.u, mean.v);
    if (std::abs(mean.area) < 0.1F) continue;
    const auto excludes = [&](const dvec3& root) {
      const dvec2 step = moved(root);
      const dvec2 f = 3.0 * (dvec2(mean.u) * step.x + dvec2(mean.v) * step.y);
      return in_float::newton_excludes(mean, vec2(f), vec3(l), 1e-5F);
    };
    ASSERT_FALSE(excludes(r)) << i;
    // And one far away is.
    excluded += excludes(dvec3(-5.0, 3.0, 3.0)) ? 1 : 0;
  }
  EXPECT_GT(excluded, static_cast<std::size_t>(functions / 10));
}

// With the least Lipschitz constant that there can be, the errors of a node's quadratic hold: of
// the position, and of the tangents across the displacement.
TEST(RayProofs, TheFitOfANodeIsAsNearAsItsErrorsSay) {
  Random random(5);
  const SurfaceChoice choice{SURFACE_SPHERE, 0.0, SHELL_NORMAL};
  double nearest = 1e9;  // of the position's error over what occurs, less 1
  for (const char* model : {"sphere-20", "torus", "relief"}) {
    const BakedScene scene = bake_with_subpatches(test::load_asset(model), choice);
    const in_double::Shape shape = shape_of(choice);
    const in_float::Shape float_shape{choice.surface, choice.shell, 0.0F};
    for (SubpatchBounds bounds : scene.subpatches) {
      if (bounds.gradient_lipschitz <= 0.0F || bounds.gradient_lipschitz == NONSMOOTH) continue;
      const Triangle& tri = scene.triangles[bounds.triangle];
      const in_double::Triangle exact = to_double(tri);
      in_float::SubTriangle node{vec3(bounds.sub_triangle), bounds.sub_triangle.w};
      for (uint64_t level = 1 + random() % 3; level > 0; --level) {
        node = in_float::child(node, static_cast<uint>(random() % 4));
      }
      uint evaluations = 0;
      // Nothing but the Lipschitz constant bounds the errors.
      bounds.corner.w = 1e9F;
      bounds.edge.w = 1e9F;
      const auto fit_by = [&](double lipschitz) {
        bounds.gradient_lipschitz = static_cast<float>(lipschitz);
        return in_float::fit_bounds(float_shape, tri, bounds, node, false, evaluations);
      };
      const in_float::Fit fit = fit_by(1.0);
      const in_float::SubTriangle wide = in_float::with_overlap(node);
      const dvec3 centre = dvec3(wide.origin) + dvec3(static_cast<double>(wide.size) / 3.0);
      // What sigma differs by from the quadratic, and how fast, over |D|, which is 1 at most at the
      // corners of a patch of this shell.
      struct Difference {
        double value;
        double gradient;
        double from_centre;
      };
      std::vector<Difference> differences;
      double lipschitz = 0.0;
      for (const dvec3& l : test::weight_grid(8)) {
        const dvec3 w = dvec3(wide.origin) + l * static_cast<double>(wide.size);
        const in_double::Displacement sigma =
            in_double::displacement_and_derivatives(shape, exact, w);
        const dvec3 c(fit.corner);
        const dvec3 e(fit.edge);
        const double q = in_double::blossom(c, e, w, w);
        const double qu = 2.0 * in_double::blossom(c, e, w, dvec3(-1.0, 1.0, 0.0));
        const double qv = 2.0 * in_double::blossom(c, e, w, dvec3(-1.0, 0.0, 1.0));
        const Difference d{std::abs(sigma.s - q), glm::length(dvec2(sigma.u - qu, sigma.v - qv)),
                           glm::length(dvec2(w.y - centre.y, w.z - centre.z))};
        differences.push_back(d);
        // What rounds in the quadratic is no difference.
        if (d.from_centre > 0.1 * std::abs(wide.size)) {
          lipschitz = std::max({lipschitz, d.gradient / d.from_centre,
                                2.0 * d.value / (d.from_centre * d.from_centre)});
        }
      }
      if (lipschitz < 1e-2) continue;
      const in_float::Fit bound = fit_by(lipschitz);
      // A hundredth more, as the samples do not show the largest one, and what the fit rounds.
      for (const Difference& d : differences) {
        ASSERT_LE(d.value, bound.position_error * 1.01 + 1e-6);
        ASSERT_LE(d.gradient, bound.tangent_error * 1.01 + 1e-5);
        nearest = std::min(nearest, bound.position_error / d.value - 1.0);
      }
    }
  }
  // It is no coarse bound.
  EXPECT_LT(nearest, 0.2);
}

}  // namespace
}  // namespace trisect
