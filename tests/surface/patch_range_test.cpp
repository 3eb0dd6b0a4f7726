// Enclosures of the surface over sub-triangles, against points of it.
#include "app/surface/patch_range.h"

#include <gtest/gtest.h>

#include <array>
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

}  // namespace
}  // namespace trisect
