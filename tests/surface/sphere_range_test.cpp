// The proven ranges of the sphere surface, held against its values in higher precision and against
// interval arithmetic without the shaders' text.
#include "app/surface/sphere_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "app/base/rounding.h"
#include "app/dispatch/kernel_float.h"
#include "tests/support/scenes.h"
#include "tests/surface/surface_long_double.h"

namespace trisect {
namespace {

using glm::dvec3;
using glm::dvec4;

// A quarter of a quarter ... of the triangle, so many times divided, any of them or the one at a
// vertex, as it is or enlarged, as nodes and cones are: then some of it lies beyond the triangle's
// border, and about a vertex.
CornerWeights random_sub_triangle(std::mt19937_64& random, int levels) {
  in_double::SubTriangle sub_triangle = kWholeTriangle;
  const bool is_at_vertex = random() % 4 == 0;
  const std::size_t vertex = random() % 3;
  for (int k = 0; k < levels; ++k) {
    sub_triangle = quarter(sub_triangle)[is_at_vertex ? vertex : random() % 4];
  }
  const std::array<double, 3> margins{0.0, double{OVERLAP}, double{CONE_MARGIN}};
  return corner_weights(in_double::enlarged(sub_triangle, margins[random() % 3]));
}

// A point of a sub-triangle, in weights of the triangle: any, or on its border.
in_long_double::vec3 random_point(std::mt19937_64& random, const CornerWeights& weights) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const long double a = std::sqrt(unit(random));
  const long double b = unit(random);
  in_long_double::vec3 l(1.0L - a, a * b, a * (1.0L - b));
  if (random() % 2 == 0) {
    const auto k = static_cast<int>(random() % 3);
    l[(k + 1) % 3] += l[k];
    l[k] = 0.0L;
  }
  return in_long_double::vec3(weights[0]) * l.x + in_long_double::vec3(weights[1]) * l.y +
         in_long_double::vec3(weights[2]) * l.z;
}

bool holds(const Interval& range, long double x) {
  return static_cast<long double>(range.lo) <= x && x <= static_cast<long double>(range.hi);
}

// The deeper a sub-triangle, the more of its ranges' width is slack for roundings: at 44 levels a
// sub-triangle is smaller than the spacing of double-precision numbers near 1.
TEST(SphereRanges, HoldSamplesOfRandomPatches) {
  std::mt19937_64 random(12);
  std::size_t with_derivatives = 0;
  std::size_t smooth = 0;
  for (int i = 0; i < 3000; ++i) {
    const uint shell = i % 2 == 0 ? SHELL_HEIGHT : SHELL_NORMAL;
    const SurfaceChoice choice{SURFACE_SPHERE, 0.0, shell};
    test::RandomPatch random_patch = test::random_patch(random, i % 3 == 0 ? 80.0 : 30.0);
    // Far from the scene's origin the vertices' sizes tell the roundings, not the edges'.
    for (dvec3& position : random_patch.positions) position += dvec3(i % 5 * 100.0);
    const Patch patch =
        patch_of(shell, bake_triangle(random_patch.positions, random_patch.normals, choice));
    const in_long_double::Triangle tri = in_long_double::widened(patch.triangle);
    const in_long_double::Shape shape{SURFACE_SPHERE, shell, 0.0L};
    for (const int levels : {0, 1, 2, 3, 5, 8, 12, 20, 44}) {
      const CornerWeights weights = random_sub_triangle(random, levels);
      const PatchCorners corners = corners_of(patch, weights);
      const auto sigma = sphere_sigma_range(patch, weights, corners);
      const auto derivatives = sphere_derivative_ranges(patch, weights, corners);
      const Interval DD = direction_square_range(patch, weights, corners);
      if (derivatives) ++with_derivatives;
      if (sphere_is_smooth(patch, weights)) ++smooth;
      // Where derivatives are bounded sigma is smooth.
      ASSERT_TRUE(!derivatives || sphere_is_smooth(patch, weights));
      for (int k = 0; k < 10; ++k) {
        const in_long_double::vec3 w = random_point(random, weights);
        const auto exact = in_long_double::displacement_and_derivatives(shape, tri, w);
        const auto D = in_long_double::shell_direction(shell, tri, w);
        ASSERT_TRUE(holds(DD, in_long_double::dot3(D, D))) << "patch " << i << " level " << levels;
        ASSERT_TRUE(!sigma || holds(*sigma, exact.s)) << "patch " << i << " level " << levels;
        if (!derivatives) continue;
        ASSERT_TRUE(holds(derivatives->s, exact.s)) << "patch " << i << " level " << levels;
        ASSERT_TRUE(holds(derivatives->u, exact.u)) << "patch " << i << " level " << levels;
        ASSERT_TRUE(holds(derivatives->v, exact.v)) << "patch " << i << " level " << levels;
      }
    }
  }
  EXPECT_GT(with_derivatives, 10000U);
  EXPECT_GT(smooth, with_derivatives);
}

// The angle of a point about a vertex, from b toward where it grows, within (-pi, pi].
double angle_about(const dvec3& x, const dvec3& b, const dvec3& axis) {
  return std::atan2(glm::dot(glm::cross(x, b), axis), glm::dot(x, b));
}

// Triangles near a vertex and about it, their corners off by up to an error of any size.
TEST(SphereRanges, HoldTheBlendAboutAVertex) {
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto anywhere = [&] {
    return dvec3(2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0, 0);
  };
  std::size_t about_vertex = 0;
  std::size_t narrow = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = std::pow(10.0, -3.0 * unit(random));
    const dvec3 centre = anywhere() * (random() % 2 == 0 ? size : 1.0);
    in_double::Corners corners{};
    for (dvec3* corner : {&corners.a, &corners.b, &corners.c}) *corner = centre + anywhere() * size;
    corners.error = random() % 2 == 0 ? 0.0 : size * std::pow(10.0, -4.0 * unit(random));
    const dvec3 b = anywhere();
    const dvec3 axis(0.0, 0.0, random() % 2 == 0 ? 1.0 : -1.0);
    const dvec4 data(1.0, 2.0, 0.2 + 2.0 * unit(random), 0.0);
    const in_double::Range blend = in_double::blend_range(corners, b, axis, data);
    double least = 10.0;
    double most = -10.0;
    for (int k = 0; k < 20; ++k) {
      const double l0 = unit(random);
      const double l1 = (1.0 - l0) * unit(random);
      // On an edge every other time.
      const double l2 = k % 2 == 0 ? 1.0 - l0 - l1 : 0.0;
      const dvec3 moved = anywhere() * (corners.error / 2.0);
      const dvec3 x = (corners.a * l0 + corners.b * l1 + corners.c * l2) / (l0 + l1 + l2) + moved;
      const double exact = std::clamp(angle_about(x, b, axis) / data.z, in_double::LEAST_BLEND,
                                      in_double::MOST_BLEND);
      least = std::min(least, exact);
      most = std::max(most, exact);
      ASSERT_LE(blend.lo, exact + 1e-12) << i;
      ASSERT_GE(blend.hi, exact - 1e-12) << i;
    }
    if (least == in_double::LEAST_BLEND && most == in_double::MOST_BLEND) ++about_vertex;
    if (blend.hi - blend.lo < 0.1) ++narrow;
  }
  EXPECT_GT(about_vertex, 1000U);
  EXPECT_GT(narrow, 1000U);
}

// s_i at a point by the quadratic formula, from intervals of one point each.
Interval height_at(const Patch& patch, std::size_t i, const dvec3& w, const Interval& c) {
  const dvec3 x = weigh(w, patch.P) - patch.P[i];
  const dvec3 D = weigh(w, patch.D);
  const Interval A = c * dot(D, D);
  const Interval B = c * dot(x, D) + dot(D, patch.N[i]);
  const Interval C = c * dot(x, x) + Interval(2.0) * dot(x, patch.N[i]);
  return -divide_by_positive(C, B + root(square(B) - A * C));
}

// On a patch of a sphere all heights are the root with the sphere's curvature, which needs no
// angle. The ranges over a point and the intervals differ by roundings only.
TEST(SphereRanges, AgreeWithIntervalsAtAPoint) {
  std::size_t points = 0;
  for (const Triangle& tri : bake(test::load_asset("sphere-80"), {SURFACE_SPHERE, 0.0}).triangles) {
    const Patch patch = patch_of(SHELL_NORMAL, tri);
    for (const dvec3& w : test::weight_grid(5, true)) {
      const CornerWeights weights{w, w, w};
      const auto sigma = sphere_sigma_range(patch, weights, corners_of(patch, weights));
      ASSERT_TRUE(sigma);
      Interval expected(0.0);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [lo, hi] = std::minmax(patch.data[i].x, patch.data[i].y);
        const Interval c(lo, hi);  // the same but for single precision's rounding
        expected = expected + Interval(w[static_cast<int>(i)]) * height_at(patch, i, w, c);
      }
      ++points;
      constexpr double most_apart = 1e-6;
      EXPECT_LT(std::abs(sigma->lo - expected.lo), most_apart);
      EXPECT_LT(std::abs(sigma->hi - expected.hi), most_apart);
      EXPECT_LE(sigma->lo, expected.hi);
      EXPECT_GE(sigma->hi, expected.lo);
      // No wider than some hundred roundings of lengths up to 2, and what c's rounding brings.
      EXPECT_LT(sigma->hi - sigma->lo, 1e-13 + (expected.hi - expected.lo) * 2.0);
    }
  }
  EXPECT_EQ(points, 80U * 6U);
}

// With flat normals everything is 0 but for roundings, and smooth.
TEST(SphereRanges, AreNarrowOnAFlatPatch) {
  const Triangle tri =
      bake_triangle({dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)},
                    {dvec3(0, 0, 1), dvec3(0, 0, 1), dvec3(0, 0, 1)}, {SURFACE_SPHERE, 0.0});
  const Patch patch = patch_of(SHELL_HEIGHT, tri);
  const CornerWeights weights{dvec3(0.5, 0.25, 0.25), dvec3(0.25, 0.5, 0.25),
                              dvec3(0.25, 0.25, 0.5)};
  const auto sigma = sphere_derivative_ranges(patch, weights, corners_of(patch, weights));
  ASSERT_TRUE(sigma);
  EXPECT_TRUE(sphere_is_smooth(patch, weights));
  for (const Interval& range : {sigma->s, sigma->u, sigma->v}) {
    EXPECT_TRUE(holds(range, 0.0L));
    EXPECT_LT(range.hi - range.lo, gamma_double(200));
  }
}

// The kernels' constants that pictures depend on are fixed; they must cover what they are for.
TEST(Gamma, IsCoveredByTheKernelsConstants) {
  EXPECT_GE(double{in_float::ROUNDINGS}, gamma_single(4));
  EXPECT_GE(double{in_float::WEIGHT_ROUNDINGS}, gamma_single(4));
  EXPECT_GE(double{in_float::HULL_ROUNDINGS}, gamma_single(16));
  EXPECT_GE(double{in_float::RANGE_SLACK}, gamma_single(16));
  const BakedScene scene;
  const TraceParams params{};
  const in_float::Kernel kernel = in_float::kernel_of(scene, params, {});
  EXPECT_GE(double{kernel.BALL_ROUNDINGS}, gamma_single(8));
  EXPECT_GE(double{kernel.PLACE_ROUNDINGS}, gamma_single(16));
  EXPECT_GE(double{BVH_SLACK}, gamma_single(15));
  EXPECT_EQ(in_double::RANGE_SLACK, gamma_double(16));
}

TEST(Gamma, IsTheErrorOfSoManyRoundings) {
  EXPECT_EQ(gamma_double(1), 0x1p-53 / (1.0 - 0x1p-53));
  EXPECT_EQ(gamma_single(3), 3.0 * 0x1p-24 / (1.0 - 3.0 * 0x1p-24));
  // A running product of 100 factors, each rounded in single precision.
  std::mt19937_64 random(13);
  std::uniform_real_distribution<float> factor(0.9F, 1.1F);
  for (int i = 0; i < 1000; ++i) {
    float rounded = factor(random);
    double exact = rounded;
    for (int n = 1; n <= 100; ++n) {
      const float f = factor(random);
      rounded *= f;
      exact *= static_cast<double>(f);
      ASSERT_LE(std::abs(static_cast<double>(rounded) - exact), gamma_single(n) * exact);
    }
  }
}

}  // namespace
}  // namespace trisect
