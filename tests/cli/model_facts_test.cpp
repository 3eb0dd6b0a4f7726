#include "app/cli/model_facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "app/mesh/mesh_builder.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

TEST(ModelFacts, OfASquareAreThoseOfThePlane) {
  const std::vector<dvec3> positions{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  const std::vector<uint32_t> triangles{0, 1, 2, 0, 2, 3};
  const ModelFacts facts = facts_of(build_mesh(positions, {}, triangles).mesh, SURFACE_PHONG);
  EXPECT_EQ(facts.low, dvec3(0, 0, 0));
  EXPECT_EQ(facts.high, dvec3(2, 2, 0));
  EXPECT_EQ(facts.largest_lean, 0.0);
  EXPECT_EQ(facts.leaning, 0U);
  EXPECT_EQ(facts.surface.folding, 0U);
  EXPECT_EQ(facts.surface.largest_displacement, 0.0);
  EXPECT_LT(facts.largest_crack, 1e-15);  // roundings
  EXPECT_EQ(facts.without_height_shell, 0U);
}

TEST(ModelFacts, OfASphereKnowItsBulge) {
  // A corner's normal leans by as much as its face is turned away: on the icosahedron by half the
  // angle between an edge's ends and a little more, some 37 degrees.
  const ModelFacts facts = facts_of(test::load_asset("sphere-20"), SURFACE_SPHERE);
  EXPECT_NEAR(facts.largest_lean, 37.4, 0.1);
  EXPECT_EQ(facts.surface.choice.surface, SURFACE_SPHERE);
  EXPECT_EQ(facts.surface.folding, 0U);
  EXPECT_GT(facts.surface.parts, 20U);
  // The sphere surface is the sphere: the middle of an edge lies at 0.851 of its radius, that of a
  // face, which is none of the points, at 0.795.
  EXPECT_GT(facts.surface.largest_displacement, 1.0 - 0.851);
  EXPECT_LT(facts.surface.largest_displacement, 1.0 - 0.794);
}

TEST(ModelFacts, FindWhatFoldsAndWhatTheHeightShellParts) {
  const ModelFacts facts = facts_of(test::load_asset("teapot"), SURFACE_PHONG);
  EXPECT_GT(facts.surface.folding, 0U);
  EXPECT_GT(facts.leaning, 0U);
  EXPECT_GT(facts.largest_crack, 1e-3);
}

TEST(ModelFacts, CountTrianglesWithoutAHeightShell) {
  // Every vertex normal lies in the plane of its face.
  const std::vector<dvec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<dvec3> normals(3, dvec3(1, 0, 0));
  const std::vector<uint32_t> triangle{0, 1, 2};
  const ModelFacts facts = facts_of(build_mesh(positions, normals, triangle).mesh, SURFACE_PHONG);
  EXPECT_EQ(facts.without_height_shell, 1U);
  EXPECT_NEAR(facts.largest_lean, 90.0, 1e-12);
}

// Models moved at random, as far as a bound was asked for.
TEST(ModelFacts, BoundWhatRoundingsMove) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto direction = [&] {
    return glm::normalize(dvec3(unit(random), unit(random), unit(random)) + dvec3(1e-9));
  };
  const Mesh mesh = test::load_asset("sphere-20");
  const SurfaceChoice choice{SURFACE_PHONG, 0.65, SHELL_NORMAL};
  const BakedScene scene = bake(mesh, choice);
  for (const double position : {0.0, 1e-3, 0.1}) {
    for (const double normal : {0.0, 1e-2, 0.2}) {
      const double bound = moved_by_rounding(mesh, 0.65, position, normal);
      double moved = 0.0;
      for (int i = 0; i < 20; ++i) {
        Mesh other = mesh;
        for (dvec3& p : other.positions) p += direction() * position;
        for (dvec3& n : other.normals) {
          // Turned by the angle of that chord.
          const dvec3 aside = glm::normalize(glm::cross(n, direction()));
          const double angle = 2.0 * std::asin(0.5 * normal);
          n = n * std::cos(angle) + aside * std::sin(angle);
        }
        const BakedScene changed = bake(other, choice);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
          const auto point = [&](const BakedScene& of, const dvec3& w) {
            return of.origin +
                   in_double::surface_point(shape_of(choice), to_double(of.triangles[t]), w);
          };
          for (const dvec3& w : test::weight_grid(6)) {
            moved = std::max(moved, glm::distance(point(scene, w), point(changed, w)));
          }
        }
      }
      EXPECT_LE(moved, bound + 1e-6);  // positions are in single precision
      EXPECT_GE(moved, 0.2 * bound - 1e-6);
    }
  }
}

TEST(ModelFacts, BoundNothingOfUnknownRoundings) {
  const Mesh mesh = test::load_asset("cube");
  for (const double alpha : {0.0, 0.65}) {
    EXPECT_EQ(moved_by_rounding(mesh, alpha, kInfinity, 0.0), kInfinity);
    EXPECT_EQ(moved_by_rounding(mesh, alpha, 0.0, kInfinity), kInfinity);
  }
}

}  // namespace
}  // namespace trisect
