// Enclosures of the surface over sub-triangles, against points of it.
#include "app/surface/patch_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "app/bake/bake.h"
#include "app/stress/stress_scenes.h"
#include "app/surface/to_double.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// Down to sub-triangles that are no larger than a rounding: there nothing but the enclosure's own
// allowance for roundings holds the point.
TEST(Enclosure, HoldsTheSurfaceOverSubTrianglesOfAllSizes) {
  std::mt19937_64 random(9);
  std::size_t points = 0;
  for (const SurfaceChoice& choice : test::kSurfaceChoices) {
    const in_double::Shape shape = shape_of(choice);
    for (int i = 0; i < 1000; ++i) {
      const double spread = std::array{5.0, 30.0, 70.0}.at(static_cast<std::size_t>(i) % 3);
      const test::RandomPatch corners = test::random_patch(random, spread);
      const Triangle tri = bake_triangle(corners.positions, corners.normals, choice);
      if (!has_surface(tri)) continue;
      const Patch patch = patch_of(choice.shell, tri);
      in_double::SubTriangle node = kWholeTriangle;
      for (int level = 0; level < 50; ++level) {
        if (level < 5 || level % 9 == 0) {
          const Enclosure enclosure = enclose(choice, patch, node);
          for (const dvec3& l : test::weight_grid(2)) {
            const dvec3 w = in_double::weights_of(node, l);
            const dvec3 S = in_double::surface_point(shape, patch.triangle, w);
            const Interval extent = extent_along(enclosure, S, stress::any_direction(random));
            ++points;
            ASSERT_LE(extent.lo, 0.0) << "surface " << choice.surface << " shell " << choice.shell
                                      << " patch " << i << " level " << level;
            ASSERT_GE(extent.hi, 0.0) << "surface " << choice.surface << " shell " << choice.shell
                                      << " patch " << i << " level " << level;
          }
        }
        node = in_double::child(node, static_cast<uint>(random() % 4));
      }
    }
  }
  EXPECT_GT(points, 200000U);
}

// Where directions nearly vanish the sphere surface's enclosure is the flat triangle with the most
// that a height can be about it; beyond the patch that is more than within.
TEST(Enclosure, HoldsTheSphereSurfaceWhereDirectionsVanish) {
  const SurfaceChoice choice{SURFACE_SPHERE, 0.0, SHELL_NORMAL};
  const in_double::Shape shape = shape_of(choice);
  std::mt19937_64 random(10);
  double farthest = 0.0;
  std::size_t wide = 0;
  for (int i = 0; i < 400; ++i) {
    const test::RandomPatch corners = test::random_patch(random, 80.0);
    const auto& [a, b, c] = corners.normals;
    // Normals that cancel out within the patch, or beyond its edge from a to b.
    const bool within = i % 2 == 0;
    const dvec3 last = within ? -(a + b) : a + b;
    if (glm::length(last) < 0.1) continue;
    Triangle tri = bake_triangle(corners.positions, {a, b, glm::normalize(last)}, choice);
    for (vec4& data : tri.VertexData) data.x = data.y = i % 4 < 2 ? -8.0F : 8.0F;
    const Patch patch = patch_of(choice.shell, tri);
    const double k = glm::length(last);
    // Weights in proportion to 1, 1 and k or -k cancel.
    const dvec3 at = dvec3(1.0, 1.0, within ? k : -k) / (within ? 2.0 + k : 2.0 - k);
    if (std::abs(at.x) > 3.0) continue;
    for (const double size : {0.5, 0.125, 1e-3}) {
      const in_double::SubTriangle node{at - size / 3.0, size};
      const Enclosure enclosure = enclose(choice, patch, node);
      if (enclosure.sigma.lo == enclosure.sigma.hi) ++wide;
      for (const dvec3& l : test::weight_grid(12)) {
        const dvec3 w = in_double::weights_of(node, l);
        const dvec3 S = in_double::surface_point(shape, patch.triangle, w);
        const dvec3 up =
            glm::normalize(in_double::shell_direction(choice.shell, patch.triangle, w));
        const Interval extent = extent_along(enclosure, S, up);
        farthest = std::max({farthest, extent.lo / patch.longest, -extent.hi / patch.longest});
      }
    }
  }
  EXPECT_LE(farthest, 0.0);
  EXPECT_GT(wide, 100U);
}

}  // namespace
}  // namespace trisect
