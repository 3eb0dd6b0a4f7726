// The shaders' surface mathematics, run in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/bake/bake.h"
#include "app/surface/surface_double.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;
using glm::dvec4;

// Computes again in double precision what the bake derives from the rounded positions and normals,
// so that identities hold to double precision.
in_double::Triangle exact(const Triangle& single) {
  in_double::Triangle tri = to_double(single);
  const dvec3 P0(tri.Position[0]);
  const dvec3 n =
      glm::normalize(glm::cross(dvec3(tri.Position[1]) - P0, dvec3(tri.Position[2]) - P0));
  tri.TriNormal = dvec4(n, tri.TriNormal.w);
  for (int i = 0; i < 3; ++i) tri.NormDot[i] = glm::dot(dvec3(tri.Normal[i]), n);
  return tri;
}

in_double::Triangle baked(const test::RandomPatch& patch) {
  return exact(bake_triangle(patch.positions, patch.normals, {}));
}

in_double::Triangle sphere_patch() {
  return exact(bake(test::load_asset("sphere-20"), {SURFACE_SPHERE, 0.0}).triangles[0]);
}

// The thesis's fields and our closed forms are derived apart from each other: they must vanish
// together.
TEST(Surface, ThesisFieldsVanishOnTheClosedForms) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 2000; ++i) {
    const in_double::Triangle tri = baked(test::random_patch(random, 60.0));
    for (const dvec3& w : test::weight_grid(6, true)) {
      const dvec3 p = in_double::surface_point({SURFACE_PHONG, SHELL_HEIGHT, 0.65}, tri, w);
      const dvec4 phong = in_double::PhongField(tri, p, 0.65);
      // Slivers among the random triangles magnify the rounding of 1e-16.
      ASSERT_NEAR(phong.w, 0.0, 1e-10) << "patch " << i;
      ASSERT_LT(glm::distance(dvec3(phong), w), 1e-9) << "patch " << i;
    }
  }
}

TEST(Surface, SphereFieldVanishesOnTheClosedForm) {
  for (const char* name : {"sphere-20", "sphere-80", "torus", "capsule", "saddle", "relief"}) {
    for (const Triangle& single : bake(test::load_asset(name), {SURFACE_SPHERE, 0.0}).triangles) {
      const in_double::Triangle tri = exact(single);
      for (const dvec3& w : test::weight_grid(8, true)) {
        const dvec3 p = in_double::surface_point({SURFACE_SPHERE, SHELL_HEIGHT, 0.0}, tri, w);
        const dvec4 field = in_double::SphereField(tri, p);
        // Near a height of 0 the listing's direction is a difference of almost equal points.
        ASSERT_NEAR(field.w, 0.0, 1e-11) << name;
        ASSERT_LT(glm::distance(dvec3(field), w), 1e-11) << name;
      }
    }
  }
}

TEST(Surface, FieldsAreDistancesAlongTheShell) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 200; ++i) {
    const in_double::Triangle tri = baked(test::random_patch(random, 30.0));
    const dvec3 w(0.3, 0.45, 0.25);
    const dvec3 D = in_double::shell_direction(SHELL_HEIGHT, tri, w);
    const dvec3 p = in_double::surface_point({SURFACE_PHONG, SHELL_HEIGHT, 0.65}, tri, w) +
                    glm::normalize(D) * 0.125;
    EXPECT_NEAR(in_double::PhongField(tri, p, 0.65).w, 0.125, 1e-10);
  }
  const in_double::Triangle tri = sphere_patch();
  EXPECT_NEAR(in_double::SphereField(tri, dvec3(tri.TriNormal) * 1.25).w, 0.25,
              3e-7);  // baked curvatures
}

TEST(Surface, SphereIsExactOnASphere) {
  for (const char* name : {"sphere-20", "sphere-80", "sphere-320"}) {
    for (const Triangle& single : bake(test::load_asset(name), {SURFACE_SPHERE, 0.0}).triangles) {
      const in_double::Triangle tri = to_double(single);
      for (const dvec3& w : test::weight_grid(10)) {
        const dvec3 p = in_double::surface_point({SURFACE_SPHERE, SHELL_HEIGHT, 0.0}, tri, w);
        // What the rounding of the baked curvatures and normals to single precision leaves.
        ASSERT_NEAR(glm::length(p), 1.0, 4e-7) << name;
        const dvec3 n = in_double::geometric_normal({SURFACE_SPHERE, SHELL_HEIGHT, 0.0}, tri, w);
        ASSERT_LT(glm::distance(n, glm::normalize(p)), 3e-6) << name;
      }
    }
  }
}

// The control points of the normal shell's Phong Tessellation, from its definition alone.
TEST(Surface, PhongInTheNormalShellIsACubicBezierTriangle) {
  std::mt19937_64 random(8);
  constexpr double alpha = 0.65;
  for (int i = 0; i < 500; ++i) {
    const in_double::Triangle tri = baked(test::random_patch(random, 120.0));
    std::array<dvec3, 3> P{};
    std::array<dvec3, 3> N{};
    for (int k = 0; k < 3; ++k) {
      P[static_cast<std::size_t>(k)] = dvec3(tri.Position[k]);
      N[static_cast<std::size_t>(k)] = dvec3(tri.Normal[k]);
    }
    const auto s = [&](std::size_t a, std::size_t b) {
      return alpha * glm::dot(P[b] - P[a], N[b] - N[a]);
    };
    const auto near = [&](std::size_t a, std::size_t b) {
      return (P[a] * 2.0 + P[b] + N[a] * s(a, b)) / 3.0;
    };
    const dvec3 middle =
        (P[0] + P[1] + P[2]) / 3.0 + (N[2] * s(0, 1) + N[0] * s(1, 2) + N[1] * s(2, 0)) / 6.0;
    for (const dvec3& w : test::weight_grid(6)) {
      const double x = w.x;
      const double y = w.y;
      const double z = w.z;
      const dvec3 expected = P[0] * (x * x * x) + P[1] * (y * y * y) + P[2] * (z * z * z) +
                             near(0, 1) * (3 * x * x * y) + near(1, 0) * (3 * x * y * y) +
                             near(1, 2) * (3 * y * y * z) + near(2, 1) * (3 * y * z * z) +
                             near(2, 0) * (3 * z * z * x) + near(0, 2) * (3 * z * x * x) +
                             middle * (6 * x * y * z);
      const dvec3 point = in_double::surface_point({SURFACE_PHONG, SHELL_NORMAL, alpha}, tri, w);
      ASSERT_LT(glm::distance(point, expected), 1e-14) << "patch " << i;
    }
  }
}

TEST(Surface, NormalShellFieldVanishesOnTheClosedForms) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 500; ++i) {
    const in_double::Triangle tri = baked(test::random_patch(random, 20.0));
    for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
      const in_double::Shape shape{surface, SHELL_NORMAL, 0.65};
      for (const dvec3& w : test::weight_grid(6, true)) {
        const dvec4 field = in_double::Field(shape, tri, in_double::surface_point(shape, tri, w));
        ASSERT_NEAR(field.w, 0.0, 1e-10) << "patch " << i;
        ASSERT_LT(glm::distance(dvec3(field), w), 1e-9) << "patch " << i;
      }
    }
  }
}

// Both faces of an edge draw the same curve in the normal shell, whatever their third vertices are.
TEST(Surface, NormalShellSharesItsEdges) {
  std::mt19937_64 random(10);
  for (int i = 0; i < 500; ++i) {
    const test::RandomPatch one = test::random_patch(random, 80.0);
    const test::RandomPatch other = test::random_patch(random, 80.0);
    for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
      const SurfaceChoice choice{surface, 0.65, SHELL_NORMAL};
      const in_double::Triangle a = to_double(bake_triangle(one.positions, one.normals, choice));
      const in_double::Triangle b =
          to_double(bake_triangle({one.positions[1], one.positions[0], other.positions[2]},
                                  {one.normals[1], one.normals[0], other.normals[2]}, choice));
      for (const double x : {0.1, 0.25, 0.5, 0.9}) {
        const dvec3 p = in_double::surface_point(shape_of(choice), a, {1.0 - x, x, 0.0});
        const dvec3 q = in_double::surface_point(shape_of(choice), b, {x, 1.0 - x, 0.0});
        // The angle between the edges rounds in single precision, so 6e-8 of one edge's curvature
        // counts on the other; slivers have curvatures of 10 and more.
        ASSERT_LT(glm::distance(p, q), 1e-6) << "patch " << i;
      }
    }
  }
}

// However far apart the normals are, as long as the shell's direction does not vanish.
TEST(Surface, SphereSurfaceIsContinuous) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const in_double::Triangle tri = baked(test::random_patch(random, 120.0));
    for (const uint shell : {SHELL_HEIGHT, SHELL_NORMAL}) {
      const in_double::Shape shape{SURFACE_SPHERE, shell, 0.0};
      const double a = unit(random);
      const double b = unit(random);
      // Across the triangle from one edge to another.
      const dvec3 from(a, 1.0 - a, 0.0);
      const dvec3 to(0.0, b, 1.0 - b);
      const auto at = [&](double x) { return glm::mix(from, to, x); };
      double x0 = 0.0;
      double x1 = 1.0;
      const auto change = [&](double x, double y) {
        return glm::distance(in_double::surface_point(shape, tri, at(x)),
                             in_double::surface_point(shape, tri, at(y)));
      };
      // Toward the largest change, by halves: a jump stays as large as it is.
      while (x1 - x0 > 1e-12) {
        const double middle = 0.5 * (x0 + x1);
        (change(x0, middle) > change(middle, x1) ? x1 : x0) = middle;
      }
      const double D = std::min(glm::length(in_double::shell_direction(shell, tri, at(x0))),
                                glm::length(in_double::shell_direction(shell, tri, at(x1))));
      if (!(D > 0.05)) continue;
      ++compared;
      // 1e-12 of the way, times the steepest of 2000 patches. A root's slope would make it 1e-6.
      ASSERT_LT(change(x0, x1), 1e-8) << "patch " << i << " shell " << shell;
    }
  }
  EXPECT_GT(compared, 3000U);
}

TEST(Surface, PhongIsBoubekeurAndAlexasProjectedOnTheShell) {
  // At a triangle's centre with normals symmetric about the face normal the shell direction is the
  // face normal, and Phong Tessellation needs no projection: compare with the paper's definition,
  // point by point.
  const in_double::Triangle tri = sphere_patch();
  const dvec3 w(1.0 / 3.0);
  const dvec3 T = in_double::base_point(tri, w);
  dvec3 blend(0.0);
  for (int i = 0; i < 3; ++i) {
    const dvec3 n(tri.Normal[i]);
    blend += (T - n * glm::dot(T - dvec3(tri.Position[i]), n)) / 3.0;
  }
  const dvec3 expected = T + (blend - T) * 0.65;
  EXPECT_LT(glm::distance(in_double::surface_point({SURFACE_PHONG, SHELL_HEIGHT, 0.65}, tri, w),
                          expected),
            1e-7);
}

TEST(Surface, KeepsTheVertices) {
  std::mt19937_64 random(7);
  const in_double::Triangle tri = baked(test::random_patch(random, 60.0));
  for (int i = 0; i < 3; ++i) {
    dvec3 w(0.0);
    w[i] = 1.0;
    for (const uint surface : {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE}) {
      EXPECT_LT(glm::distance(in_double::surface_point({surface, SHELL_HEIGHT, 0.65}, tri, w),
                              dvec3(tri.Position[i])),
                1e-12);
    }
  }
}

TEST(Surface, FlatNormalsGiveTheFlatTriangle) {
  test::RandomPatch patch{{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)},
                          {dvec3(0, 0, 1), dvec3(0, 0, 1), dvec3(0, 0, 1)}};
  const in_double::Triangle tri = baked(patch);
  for (const dvec3& w : test::weight_grid(5)) {
    for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
      EXPECT_EQ(in_double::displacement({surface, SHELL_HEIGHT, 0.65}, tri, w), 0.0);
      EXPECT_EQ(in_double::geometric_normal({surface, SHELL_HEIGHT, 0.65}, tri, w), dvec3(0, 0, 1));
    }
  }
}

// Weights within the triangle, on its edges, where the difference across a nonsmooth edge would be
// a mean of both sides, and beyond them by the overlap of neighbouring patches.
std::vector<dvec3> weights_about_the_triangle() {
  std::vector<dvec3> weights = test::weight_grid(5, true);
  for (int edge = 0; edge < 3; ++edge) {
    for (const double along : {0.2, 0.5, 0.8}) {
      for (const double beyond : {0.0, double{OVERLAP}}) {
        dvec3 w(-beyond);
        w[(edge + 1) % 3] = along;
        w[(edge + 2) % 3] = 1.0 + beyond - along;
        weights.push_back(w);
      }
    }
  }
  return weights;
}

TEST(Surface, GeometricNormalIsThatOfDifferences) {
  std::mt19937_64 random(8);
  const std::vector<dvec3> weights = weights_about_the_triangle();
  constexpr double h = 1e-5;  // central differences: h^2 of truncation, 1e-16 / h of rounding
  for (int i = 0; i < 500; ++i) {
    const in_double::Triangle tri = baked(test::random_patch(random, 35.0));
    for (const in_double::Shape& shape : {in_double::Shape{SURFACE_PHONG, SHELL_HEIGHT, 0.65},
                                          in_double::Shape{SURFACE_SPHERE, SHELL_HEIGHT, 0.0},
                                          in_double::Shape{SURFACE_PHONG, SHELL_NORMAL, 0.65},
                                          in_double::Shape{SURFACE_SPHERE, SHELL_NORMAL, 0.0}}) {
      for (const dvec3& w : weights) {
        const auto difference = [&](const dvec3& step) {
          return in_double::surface_point(shape, tri, w + step * h) -
                 in_double::surface_point(shape, tri, w - step * h);
        };
        const dvec3 s_u = difference({-1, 1, 0});
        const dvec3 s_v = difference({-1, 0, 1});
        const dvec3 expected = glm::normalize(glm::cross(s_u, s_v));
        const dvec3 normal = in_double::geometric_normal(shape, tri, w);
        // Slivers among the random triangles have steep derivatives.
        ASSERT_LT(glm::distance(normal, expected), 1e-4)
            << "patch " << i << " surface " << shape.surface << " shell " << shape.shell;
      }
    }
  }
}

// s of a line through x, seen from a vertex at the origin.
double sphere_s(const dvec3& x, const dvec3& D, const dvec3& N, double c) {
  return in_double::sphere_line(x, D, N, c).s;
}

TEST(SphereLine, MeetsTheSphere) {
  // A unit sphere that touches z = 0 from below at the origin, and lines up through it, up to 60
  // degrees off its normal where they leave it.
  for (const double x : {0.0, 0.3, 0.866}) {
    const in_double::SphereLine line =
        in_double::sphere_line({x, 0, -0.5}, {0, 0, 1}, {0, 0, 1}, 1.0);
    EXPECT_TRUE(line.regular);
    // The square, 1 - x^2, is exact to 1e-16; its root to that over itself.
    EXPECT_NEAR(-0.5 + line.s, std::sqrt(1.0 - x * x) - 1.0, 1e-15);
  }
  // Curvature 0 is the plane, and it is approached smoothly from both sides.
  for (const double c : {0.0, 1e-12, -1e-12, 1e-300}) {
    EXPECT_NEAR(sphere_s({0.5, 0, 0.25}, {0, 0, 1}, {0, 0, 1}, c), -0.25, 1e-12);
  }
  // A line that misses the sphere: about its point next to the centre, where one that touches it
  // is.
  EXPECT_NEAR(sphere_s({2, 0, 0}, {0, 0, 1}, {0, 0, 1}, 1.0), -1.0, 0.25);
  EXPECT_NEAR(sphere_s({8, 0, 0}, {0, 0, 1}, {0, 0, 1}, 1.0), -1.0, 0.25);
  // At the vertex itself, even along the tangent plane.
  EXPECT_EQ(sphere_s({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0.0), 0.0);
}

// Where the line becomes flat to the sphere, touches it, misses it; and where the way that it goes
// through it turns round, at which the nearer of two points becomes the farther one. s and its
// slope change by no more than the step's part of them: nothing jumps, nothing is steep.
TEST(SphereLine, LeavesTheDefinitionSmoothly) {
  const double step = 1e-4;
  int irregular = 0;
  double steepest = 0.0;
  for (const double c : {2.0, 1.0, 0.3, 0.0, -0.3, -1.0, -2.0}) {
    for (const double turn : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.1}) {
      const dvec3 x(0.8 * std::cos(turn), 0.0, 0.8 * std::sin(turn));
      const auto at = [&](double angle) {
        return in_double::sphere_line(x, {std::sin(angle), 0.0, std::cos(angle)}, {0, 0, 1}, c);
      };
      for (double angle = -3.1; angle < 3.1; angle += step) {
        const in_double::SphereLine line = at(angle);
        const double change = at(angle + step).s - line.s;
        const double next_change = at(angle + 2.0 * step).s - line.s - change;
        steepest = std::max(steepest, std::abs(change) / step);
        ASSERT_LT(std::abs(next_change - change), 100.0 * step * step)
            << c << " " << turn << " " << angle;
        if (!line.regular) ++irregular;
      }
    }
  }
  EXPECT_LT(steepest, 20.0);
  EXPECT_GT(irregular, 1000000);
}

// The root is the same on both sides of where B changes sign and the nearer of the two becomes the
// farther one.
TEST(SphereLine, StaysOnOneSideOfTheSphere) {
  const double h = 1e-9;
  for (const double c : {1.0, -1.0}) {
    for (const double inside : {-0.5, 0.5}) {
      // A line across the tangent plane's direction through a point beside the centre, -N / c.
      const dvec3 x0(0.0, inside, -1.0 / c);
      const double before = sphere_s(x0 - dvec3(0, 0, h), {0, 0, 1}, {0, 0, 1}, c);
      const double after = sphere_s(x0 + dvec3(0, 0, h), {0, 0, 1}, {0, 0, 1}, c);
      EXPECT_NEAR(before, after, 3.0 * h);
    }
  }
}

TEST(SphereHeight, IsHeldByTheDistanceFromItsVertex) {
  const dvec3 N(0, 0, 1);
  const auto length = [&](const dvec3& T, const dvec3& D) {
    return in_double::sphere_height(in_double::sphere_line(T, D, N, 0.0)) * glm::length(D);
  };
  const dvec3 T(0, 0.3, 0.4);  // 0.5 from the vertex
  // To the plane at right angles, and 60 degrees off its normal.
  EXPECT_NEAR(length(T, {0, 0, 2}), -0.4, 1e-15);
  EXPECT_NEAR(length({0, 0.4, 0.2}, {std::sqrt(3.0), 0, 1.0}), -0.4, 1e-15);
  // Where that is farther than 5/4 of the distance from the vertex: 0.8 is 0.96 times the highest,
  // 5/3 of 0.5.
  EXPECT_NEAR(length(T, {std::sqrt(3.0), 0, 1.0}), -(5.0 / 6.0) * (1.0 - 0.29 * 0.29), 1e-15);
  // Beneath the tangent plane.
  EXPECT_EQ(length(T, {1.0, 0.0, -1.0}), 0.0);
}

TEST(Bisect, ConvergesOnTheSphere) {
  const in_double::Triangle tri = sphere_patch();
  const dvec3 n(tri.TriNormal);
  const dvec3 origin = n * 3.0;
  const in_double::vec2 bounds = in_double::rsi(origin - dvec3(tri.Domain), -n, tri.Domain.w);
  double depth = 0.0;
  dvec3 weights(0.0);
  ASSERT_TRUE(in_double::chord_ahead(bounds));
  ASSERT_TRUE(in_double::bisect({SURFACE_SPHERE, SHELL_HEIGHT, 0.0}, tri, bounds, origin, -n, 40,
                                std::ldexp(1.0, -40), 1e-6, 10.0, depth, weights));
  EXPECT_NEAR(depth, 2.0, 4e-7);  // what the rounding of the baked numbers leaves
  EXPECT_LT(glm::distance(weights, dvec3(1.0 / 3.0)), 1e-6);
  // Nearer hits have been found already, or the surface is seen from behind: no hit.
  EXPECT_FALSE(in_double::bisect({SURFACE_SPHERE, SHELL_HEIGHT, 0.0}, tri, bounds, origin, -n, 40,
                                 std::ldexp(1.0, -40), 1e-6, 1.9, depth, weights));
  const in_double::vec2 behind = in_double::rsi(-n - dvec3(tri.Domain), n, tri.Domain.w);
  EXPECT_FALSE(in_double::bisect({SURFACE_SPHERE, SHELL_HEIGHT, 0.0}, tri, behind, -n, n, 40,
                                 std::ldexp(1.0, -40), 1e-6, 10.0, depth, weights));
}

TEST(AngleBetween, IsExactNearZero) {
  EXPECT_NEAR(in_double::AngleBetween({1, 0, 0}, {1, 1e-10, 0}), 1e-10, 1e-24);
  EXPECT_NEAR(in_double::AngleBetween({1, 0, 0}, {-1, 0, 0}), std::acos(-1.0), 1e-15);
  EXPECT_EQ(in_double::AngleBetween({0, 0, 0}, {1, 0, 0}), 0.0);
}

}  // namespace
}  // namespace trisect
