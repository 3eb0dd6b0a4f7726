// Whatever a mesh is like, its baked scene holds no NaN and no infinity.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/mesh/mesh_builder.h"
#include "app/oracle/oracle.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/finite_scene.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

const std::vector<SurfaceChoice> kAllChoices{
    {SURFACE_FLAT, 0.65, SHELL_NORMAL},  {SURFACE_FLAT, 0.65, SHELL_HEIGHT},
    {SURFACE_PHONG, 0.65, SHELL_NORMAL}, {SURFACE_PHONG, 0.65, SHELL_HEIGHT},
    {SURFACE_PHONG, 1e3, SHELL_HEIGHT},  {SURFACE_SPHERE, 0.65, SHELL_NORMAL},
    {SURFACE_SPHERE, 0.65, SHELL_HEIGHT}};

// The bake of a mesh on every surface and in every shell, each beside a patch that has a surface.
void expect_finite(const Mesh& mesh, const std::string& what) {
  const Mesh both = stress::joined(mesh, stress::leaning_patch(10.0), dvec3(0.0, 0.0, 2.0));
  for (const SurfaceChoice& choice : kAllChoices) {
    BakedScene scene = bake_with_subpatches(both, choice);
    scene.bvh = build_bvh(scene);
    EXPECT_EQ(test::first_not_finite(scene), "")
        << what << ", " << surface_name(choice.surface) << ", " << shell_name(choice.shell);
  }
}

TEST(FiniteScene, WithNormalsInTheFacesPlaneAndNearIt) {
  for (const double along : {0.0, 1e-40, 1e-30, 1e-8, 2.4e-4, 3e-4}) {
    for (const double sign : {1.0, -1.0}) {
      for (const int corners : {1, 3}) {
        stress::Corners normals{dvec3(0, 0, 1), dvec3(0, 0, 1), dvec3(0, 0, 1)};
        const std::array<dvec3, 3> in_plane{dvec3(1, 0, 0), dvec3(-0.6, 0.8, 0), dvec3(0, 1, 0)};
        for (std::size_t k = 0; k < static_cast<std::size_t>(corners); ++k) {
          normals[k] = in_plane[k] + dvec3(0.0, 0.0, sign * along);
        }
        expect_finite(stress::plain_patch(normals),
                      fmt::format("{} normals {} off the plane", corners, sign * along));
      }
    }
  }
}

// Opposite normals cancel out: on the way from one to the other the normal shell has no direction.
TEST(FiniteScene, WithOppositeNormals) {
  for (const dvec3& n : {dvec3(0, 0, 1), dvec3(1, 0, 0), dvec3(0.6, 0, 0.8)}) {
    expect_finite(stress::plain_patch({n, -n, n}), "opposite normals");
    expect_finite(stress::plain_patch({n, -n, dvec3(0, 0, 1)}), "opposite normals");
  }
}

TEST(FiniteScene, WithTrianglesThatRoundingFlattens) {
  const stress::Corners up{dvec3(0, 0, 1), dvec3(0.6, 0, 0.8), dvec3(0, -0.6, 0.8)};
  for (const double far : {0.0, 1e8}) {
    for (const double size : {1e-20, 1e-42, 1e-100}) {
      const dvec3 at(far, 0.3 * far, 0.0);
      // Small in every direction; thin; with a short edge.
      expect_finite(stress::patch({at, at + dvec3(size, 0, 0), at + dvec3(0, size, 0)}, up),
                    fmt::format("small: {} at {}", size, far));
      expect_finite(stress::patch({at, at + dvec3(1, 0, 0), at + dvec3(0.4, size, 0)}, up),
                    fmt::format("thin: {} at {}", size, far));
      expect_finite(stress::patch({at, at + dvec3(1, 0, 0), at + dvec3(0, size, 0)}, up),
                    fmt::format("short: {} at {}", size, far));
    }
  }
}

// Small integers: many normals in faces' planes, opposite, or of no length; many degenerate faces.
TEST(FiniteScene, WithSmallIntegersForEveryCoordinate) {
  std::mt19937 random(3);
  std::size_t without_surface = 0;
  for (int k = 0; k < 10; ++k) {
    const auto any = [&] { return dvec3(random() % 3, random() % 3, random() % 3) - 1.0; };
    std::vector<dvec3> positions;
    std::vector<dvec3> normals;
    for (int i = 0; i < 4; ++i) {
      positions.push_back(any());
      normals.push_back(any());
    }
    const std::array<uint32_t, 12> indices{0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
    try {
      const Mesh mesh = build_mesh(positions, normals, indices).mesh;
      expect_finite(mesh, fmt::format("mesh {}", k));
      without_surface +=
          count_without_surface(bake(stress::joined(mesh, stress::leaning_patch(10.0), {}),
                                     {SURFACE_PHONG, 0.65, SHELL_HEIGHT}));
    } catch (const InputError&) {
      // Every face is degenerate.
    }
  }
  EXPECT_GT(without_surface, 5U);
}

TEST(NoSurface, IsWhereANormalLiesInTheFacesPlaneAndOnlyInTheHeightShell) {
  const auto patches = [](double along, const SurfaceChoice& choice) {
    const dvec3 up(0, 0, 1);
    const Mesh mesh = stress::plain_patch({dvec3(-1, 0, along), up, up});
    return bake_with_subpatches(stress::joined(mesh, stress::leaning_patch(10.0), dvec3(0, 0, 1)),
                                choice);
  };
  for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
    for (const double along : {0.0, 1e-30, -1e-30, 2.4e-4, -2.4e-4}) {
      const BakedScene scene = patches(along, {surface, 0.65, SHELL_HEIGHT});
      EXPECT_EQ(count_without_surface(scene), 1U) << along;
      EXPECT_FALSE(has_surface(scene.triangles[0]));
      for (const SubpatchBounds& bounds : scene.subpatches) EXPECT_EQ(bounds.triangle, 1U);
      EXPECT_EQ(count_without_surface(patches(along, {surface, 0.65, SHELL_NORMAL})), 0U);
      EXPECT_EQ(count_without_surface(patches(along, {SURFACE_FLAT, 0.65, SHELL_HEIGHT})), 0U);
    }
    for (const double along : {2.5e-4, -2.5e-4, -1.0}) {
      EXPECT_EQ(count_without_surface(patches(along, {surface, 0.65, SHELL_HEIGHT})), 0U) << along;
    }
  }
}

TEST(NoSurface, TheOracleHasNoneEither) {
  const dvec3 up(0, 0, 1);
  const Mesh mesh = stress::joined(stress::plain_patch({dvec3(-1, 0, 0), up, up}),
                                   stress::leaning_patch(10.0), dvec3(5, 0, 0));
  for (const uint shell : {SHELL_NORMAL, SHELL_HEIGHT}) {
    const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, shell});
    const dvec3 middle =
        (dvec3(scene.triangles[0].Position[0]) + dvec3(scene.triangles[0].Position[1]) +
         dvec3(scene.triangles[0].Position[2])) /
        3.0;
    const OracleAnswer answer = Oracle(scene).first({middle + 5.0 * up, -up}, 1e-7);
    EXPECT_TRUE(answer.decidable);
    EXPECT_EQ(answer.hit, shell == SHELL_NORMAL);
  }
}

TEST(NoSurface, OfAllTrianglesIsAnError) {
  const Mesh mesh = stress::plain_patch({dvec3(-1, 0, 0), dvec3(0, 0, 1), dvec3(0, 0, 1)});
  EXPECT_THROW(bake(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT}), InputError);
  EXPECT_NO_THROW(bake(mesh, {SURFACE_FLAT, 0.65, SHELL_HEIGHT}));
  EXPECT_NO_THROW(bake(mesh, {SURFACE_PHONG, 0.65, SHELL_NORMAL}));
}

TEST(FiniteScene, IsToldFromOneThatIsNot) {
  const BakedScene good =
      bake_with_subpatches(stress::leaning_patch(10.0), {SURFACE_SPHERE, 0.65, SHELL_NORMAL});
  EXPECT_EQ(test::first_not_finite(good), "");
  BakedScene bad = good;
  bad.triangles[0].NormDot.y = 0.0F;
  EXPECT_EQ(test::first_not_finite(bad), "triangle 0");
  bad = good;
  bad.subpatches[0].edge.z = std::nanf("");
  EXPECT_EQ(test::first_not_finite(bad), "subpatch 0");
}

}  // namespace
}  // namespace trisect
