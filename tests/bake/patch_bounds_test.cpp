// The bounds are proven in patch_bounds.h; these tests look for mistakes in the proof and the code.
#include "app/bake/patch_bounds.h"

#include <gtest/gtest.h>

#include <random>

#include "app/bake/bake.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// The largest distance of a point of the patch from the centre of its Domain, over the radius.
double farthest_over_radius(const SurfaceChoice& choice, const Triangle& baked) {
  const in_double::Triangle tri = to_double(baked);
  double farthest = 0.0;
  for (const dvec3& w : test::weight_grid(24)) {
    const dvec3 point = in_double::surface_point(shape_of(choice), tri, w);
    const double distance = glm::distance(point, dvec3(tri.Domain)) / tri.Domain.w;
    // A normal at right angles to the face leaves the height shell undefined (NaN) there.
    if (distance > farthest) farthest = distance;
  }
  return farthest;
}

const std::vector<SurfaceChoice>& cases() {
  static const std::vector<SurfaceChoice> all = [] {
    std::vector<SurfaceChoice> choices{{SURFACE_FLAT, 0.0}};
    for (const uint shell : {SHELL_HEIGHT, SHELL_NORMAL}) {
      for (const double alpha : {0.0, 0.65, 1.0, 2.0, -1.0, 50.0}) {
        choices.push_back({SURFACE_PHONG, alpha, shell});
      }
      choices.push_back({SURFACE_SPHERE, 0.0, shell});
    }
    return choices;
  }();
  return all;
}

TEST(PatchBounds, ContainEveryPatchOfEveryAsset) {
  for (const std::string& name : test::asset_names()) {
    const Mesh mesh = test::load_asset(name);
    for (const SurfaceChoice& choice : cases()) {
      for (const Triangle& tri : bake(mesh, choice).triangles) {
        ASSERT_LE(farthest_over_radius(choice, tri), 1.0)
            << name << " surface " << choice.surface << " shell " << choice.shell;
      }
    }
  }
}

TEST(PatchBounds, ContainRandomPatchesWithNormalsInEveryDirection) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 3000; ++i) {
    // Up to 180 degrees off the face: folded shells, displacements at their limit.
    const test::RandomPatch patch = test::random_patch(random, i % 3 == 0 ? 180.0 : 85.0);
    for (const SurfaceChoice& choice : cases()) {
      const Triangle tri = bake_triangle(patch.positions, patch.normals, choice);
      ASSERT_LE(farthest_over_radius(choice, tri), 1.0)
          << "patch " << i << " surface " << choice.surface << " shell " << choice.shell;
    }
  }
}

TEST(PatchBounds, AreFiniteForNormalsAtRightAnglesToTheFace) {
  for (const uint surface : {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE}) {
    const Triangle tri =
        bake_triangle({dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)},
                      {dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(0, 0, -1)}, {surface, 0.65});
    EXPECT_GT(tri.Domain.w, 0.7F);
    EXPECT_LT(tri.Domain.w, 3.5F);
  }
}

TEST(PatchBounds, AreTight) {
  // On the sphere of 20 triangles the circle through the vertices has radius 0.607 and the sphere
  // bulges by 0.205.
  for (const SurfaceChoice& choice : cases()) {
    if (std::abs(choice.alpha) > 0.65) continue;
    const Triangle tri = bake(test::load_asset("sphere-20"), choice).triangles[0];
    EXPECT_GE(tri.Domain.w, 0.607F);
    EXPECT_LE(tri.Domain.w, 0.607F * 1.15F)
        << "surface " << choice.surface << " shell " << choice.shell;
  }
}

TEST(EnclosingBall, IsAlmostTheSmallest) {
  const std::vector<Ball> corners{
      {{1, 1, 1}, 0.0}, {{-1, -1, 1}, 0.0}, {{-1, 1, -1}, 0.0}, {{1, -1, -1}, 0.0}};
  const Ball ball = enclosing_ball(corners);
  EXPECT_GE(ball.radius, std::sqrt(3.0) * (1.0 - 1e-12));
  EXPECT_LE(ball.radius, std::sqrt(3.0) * 1.01);
  const std::vector<Ball> two{{{0, 0, 0}, 1.0}, {{3, 0, 0}, 0.5}};  // from x = -1 to 3.5
  EXPECT_GE(enclosing_ball(two).radius, 2.25 * (1.0 - 1e-12));
  EXPECT_LE(enclosing_ball(two).radius, 2.25 * 1.02);
  EXPECT_EQ(enclosing_ball(std::vector<Ball>{{{5, 6, 7}, 2.0}}).radius, 2.0);
}

}  // namespace
}  // namespace trisect
