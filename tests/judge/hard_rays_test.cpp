#include "app/judge/hard_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/judge/cast_files.h"
#include "app/judge/judged_ray.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

BakedScene in_place(const std::string& model, uint surface) {
  return bake_about(test::load_asset(model), {surface, 0.65, SHELL_NORMAL}, dvec3(0.0));
}

double distance_of(const FileRay& ray, const dvec3& point) {
  return glm::length(glm::cross(point - ray.origin, glm::normalize(ray.direction)));
}

TEST(HardRays, AreManyOfSinglePrecisionAndTheSameForASeed) {
  const BakedScene scene = in_place("torus", SURFACE_SPHERE);
  for (const RayKind& kind : kRayKinds) {
    const std::vector<FileRay> rays = hard_rays(scene, kind.name, 50, 3);
    ASSERT_EQ(rays.size(), 50U) << kind.name;
    for (const FileRay& ray : rays) {
      EXPECT_EQ(ray.origin, dvec3(glm::vec3(ray.origin))) << kind.name;
      EXPECT_EQ(ray.direction, dvec3(glm::vec3(ray.direction))) << kind.name;
      EXPECT_NEAR(glm::length(ray.direction), 1.0, 2e-7) << kind.name;
    }
    EXPECT_EQ(rays_for("a", rays), rays_for("a", hard_rays(scene, kind.name, 50, 3)));
    EXPECT_NE(rays_for("a", rays), rays_for("a", hard_rays(scene, kind.name, 50, 4)));
  }
  EXPECT_THROW(hard_rays(scene, "all", 1, 1), std::out_of_range);
}

TEST(HardRays, AreOfTheirKind) {
  for (const uint surface : {SURFACE_FLAT, SURFACE_PHONG}) {
    const BakedScene scene = in_place("sphere-20", surface);
    const double R = scene.extent;
    // By the roundings of an origin four radii away and of a direction over as long a way.
    const double off = 4.0 * 1.2e-7 * 4.0 * R;
    for (const FileRay& ray : hard_rays(scene, "vertex", 100, 1)) {
      double nearest = R;
      for (const Triangle& tri : scene.triangles) {
        for (const vec4& p : tri.Position) {
          nearest = std::min(nearest, distance_of(ray, dvec3(p)));
        }
      }
      EXPECT_LT(nearest, off);
    }
    for (const FileRay& ray : hard_rays(scene, "far", 100, 1)) {
      EXPECT_NEAR(glm::length(ray.origin), 1e4 * R, 2.0 * R);
    }
    for (const FileRay& ray : hard_rays(scene, "axis", 100, 1)) {
      const dvec3& d = ray.direction;
      EXPECT_TRUE(d.x == 0.0 || d.y == 0.0 || d.z == 0.0);
    }
    for (const FileRay& ray : hard_rays(scene, "leaving", 100, 1)) {
      EXPECT_LT(glm::length(ray.origin), 1.1 * R);
      EXPECT_GT(ray.t_min, 0.0);
    }
  }
}

// On a closed surface rays at edges and vertices hit, and rays that begin outside first see its
// front.
TEST(HardRays, AtAClosedSurfaceHit) {
  const BakedScene scene = in_place("sphere-20", SURFACE_PHONG);
  for (const char* kind : {"random", "vertex", "edge", "axis"}) {
    const std::vector<FileRay> rays = hard_rays(scene, kind, 100, 1);
    const std::vector<FileHit> hits = *cast_by_oracle(scene, rays, {});
    const Judgement sum = sum_of(*judged_rays(scene, rays, hits, {}));
    EXPECT_EQ(sum.hits + sum.undecidable, 100U) << kind;
    // Some of those at vertices and edges pass the outline.
    EXPECT_LT(sum.undecidable, 40U) << kind;
  }
}

}  // namespace
}  // namespace trisect
