// Ranges of tangents, against the surface in higher precision.
#include "app/surface/tangent_range.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "app/bake/bake.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/scenes.h"
#include "tests/surface/surface_long_double.h"

namespace trisect {
namespace {

using glm::dvec3;

// Between any two points of a sub-triangle the surface changes by what the ranges of its tangents
// say: sub-triangles of all sizes, some of which reach beyond the patch, steep normals among them,
// for which the sphere surface is not differentiable everywhere.
TEST(TangentRanges, HoldWhatTheSurfaceChangesBy) {
  std::mt19937_64 random(31);
  for (const SurfaceChoice& choice : test::kSurfaceChoices) {
    SCOPED_TRACE(testing::Message() << "surface " << choice.surface << " shell " << choice.shell);
    const in_long_double::Shape shape{choice.surface, choice.shell,
                                      static_cast<long double>(choice.alpha)};
    std::size_t bounded = 0;
    for (int i = 0; i < 1000; ++i) {
      const double spread = std::array{5.0, 30.0, 70.0}.at(static_cast<std::size_t>(i) % 3);
      test::RandomPatch corners = test::random_patch(random, spread);
      // Far from the scene's origin the vertices' sizes tell the roundings, not the edges'.
      for (dvec3& position : corners.positions) position += dvec3(i % 5 * 100.0);
      const Triangle baked = bake_triangle(corners.positions, corners.normals, choice);
      if (!has_surface(baked)) continue;
      const Patch patch = patch_of(choice.shell, baked);
      const in_long_double::Triangle tri = in_long_double::widened(patch.triangle);
      in_double::SubTriangle node = kWholeTriangle;
      for (int level = 0; level < 14; ++level) {
        const in_double::SubTriangle piece = in_double::enlarged(node, i % 2 == 0 ? 0.125 : 0.0);
        const std::array<dvec3, 3> axes{stress::any_direction(random),
                                        stress::any_direction(random),
                                        stress::any_direction(random)};
        const auto ranges = tangent_ranges(choice, patch, piece, axes);
        node = in_double::child(node, static_cast<uint>(random() % 4));
        if (!ranges) continue;
        ++bounded;
        // Two points far apart, or near each other.
        const dvec3 a = test::random_weights(random);
        dvec3 b = test::random_weights(random);
        if (level % 2 == 0) b = a + (b - a) * 1e-3;
        const auto point = [&](const dvec3& l) {
          const in_long_double::vec3 w =
              in_long_double::vec3(piece.origin) +
              in_long_double::vec3(l) * static_cast<long double>(piece.size);
          // Of weights whose sum is 1: the first gives way.
          return in_long_double::surface_point(shape, tri,
                                               in_long_double::vec3(1.0L - w.y - w.z, w.y, w.z));
        };
        const in_long_double::vec3 moved = point(b) - point(a);
        // Some forty roundings of the points in the test's own precision.
        const long double rounding = 40.0L * std::numeric_limits<long double>::epsilon() *
                                     static_cast<long double>(longest_of(patch.P));
        for (std::size_t k = 0; k < 3; ++k) {
          const long double change = glm::dot(moved, in_long_double::vec3(axes[k]));
          const Interval expected = ranges->u[k] * (b.y - a.y) + ranges->v[k] * (b.z - a.z);
          ASSERT_LE(static_cast<long double>(expected.lo), change + rounding)
              << i << " at level " << level;
          ASSERT_GE(static_cast<long double>(expected.hi), change - rounding)
              << i << " at level " << level;
        }
      }
    }
    // Of 14,000: all but those of the sphere surface about vertices and steep normals.
    EXPECT_GT(bounded, choice.surface == SURFACE_SPHERE ? 3000U : 11000U);
  }
}

// On small pieces they are as narrow as the surface bends: what is left of a range at a quarter of
// the size is not much more than a quarter.
TEST(TangentRanges, ShrinkWithThePiece) {
  std::mt19937_64 random(32);
  for (const SurfaceChoice& choice : {SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_NORMAL},
                                      SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_HEIGHT},
                                      SurfaceChoice{SURFACE_SPHERE, 0.0, SHELL_NORMAL}}) {
    SCOPED_TRACE(testing::Message() << "surface " << choice.surface << " shell " << choice.shell);
    std::size_t bounded = 0;
    for (int i = 0; i < 50; ++i) {
      const test::RandomPatch corners = test::random_patch(random, 10.0);
      const Patch patch =
          patch_of(choice.shell, bake_triangle(corners.positions, corners.normals, choice));
      const dvec3 axis = stress::any_direction(random);
      // By the weights of the patch; 0 if there is no bound.
      const auto width_at = [&](int level) {
        in_double::SubTriangle node = kWholeTriangle;
        for (int k = 0; k < level; ++k) node = in_double::child(node, 3);
        const auto ranges = tangent_ranges(choice, patch, node, {axis, axis, axis});
        return ranges ? (ranges->u[0].hi - ranges->u[0].lo) / std::abs(node.size) : 0.0;
      };
      const double wide = width_at(4);
      const double narrow = width_at(6);
      if (wide == 0.0 || narrow == 0.0) continue;
      ++bounded;
      EXPECT_LT(narrow, 0.35 * wide) << i;
    }
    EXPECT_GT(bounded, 40U);
  }
}

}  // namespace
}  // namespace trisect
