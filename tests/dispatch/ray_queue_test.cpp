// Rays have the same hits however often they pause.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <random>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/ray_caster.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

class Queue : public test::GpuTest {};

std::vector<CastHit> cast(const BakedScene& scene, const TraceSettings& settings,
                          const std::vector<CastRay>& rays, uint32_t steps) {
  return RayCaster(test::validated_device(), scene, make_params(scene, settings), settings.solver,
                   nullptr, steps)
      .cast(rays);
}

TEST_F(Queue, PausesLoseNothing) {
  // In the height shell patches are divided: rays pause within subpatches, and skip those of a
  // patch whose ball they miss.
  const Mesh mesh = test::load_asset("sphere-20");
  const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  ASSERT_TRUE(has_divided_patches(scene));
  TraceSettings settings = test::framed(mesh, scene, 8, 8, 10);
  settings.solver = SOLVER_ROBUST;
  std::mt19937_64 random(5);
  const std::vector<CastRay> rays = stress::rays_at_surface(scene, random, 500);
  const std::vector<CastHit> expected = cast(scene, settings, rays, RayQueue::kSteps);
  for (const uint32_t steps : {1U, 37U}) {
    const std::vector<CastHit> hits = cast(scene, settings, rays, steps);
    ASSERT_EQ(hits.size(), expected.size());
    EXPECT_EQ(std::memcmp(hits.data(), expected.data(), hits.size() * sizeof(CastHit)), 0) << steps;
  }
}

TEST_F(Queue, RaysThatGoByATreeMeetTheSame) {
  const Mesh mesh = test::load_asset("sphere-20");
  BakedScene scene = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  TraceSettings settings = test::framed(mesh, scene, 8, 8, 10);
  settings.solver = SOLVER_ROBUST;
  std::mt19937_64 random(6);
  std::vector<CastRay> rays = stress::rays_at_surface(scene, random, 500);
  // Some along the axes: they are parallel to slabs of the boxes, which they meet nowhere or
  // everywhere.
  for (CastRay& ray : rays) {
    if (random() % 4 > 0) continue;
    ray.direction = vec4(0.0F);
    ray.direction[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 1.0F : -1.0F;
  }
  const std::vector<CastHit> expected = cast(scene, settings, rays, RayQueue::kSteps);
  scene.bvh = build_bvh(scene);
  for (const uint32_t steps : {1U, 37U, RayQueue::kSteps}) {
    const std::vector<CastHit> hits = cast(scene, settings, rays, steps);
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
      // All members but the counts of work.
      EXPECT_EQ(std::memcmp(&hits[i], &expected[i], offsetof(CastHit, evaluations)), 0)
          << i << " in passes of " << steps;
    }
  }
}

// The farther a ray's anchor, the more its points are off by roundings, and most where it meets a
// box at a small angle. Those of a cube's faces are thinner than that.
TEST_F(Queue, RaysThatGoByATreeMeetTheSameFarFromTheirAnchors) {
  const Mesh mesh = test::load_asset("cube");
  BakedScene scene = bake_with_subpatches(mesh, {SURFACE_FLAT, 0.0});
  TraceSettings settings = test::framed(mesh, scene, 8, 8, 10);
  settings.solver = SOLVER_ROBUST;
  std::mt19937_64 random(7);
  std::vector<CastRay> rays;
  for (int i = 0; i < 500; ++i) {
    const stress::SurfacePoint point = stress::any_point(scene, random);
    const glm::dvec3 direction = stress::across(point.normal, random) -
                                 std::ldexp(1.0, -static_cast<int>(random() % 12)) * point.normal;
    CastRay ray = stress::ray_exactly_through(scene, point.position, direction);
    ray.anchor -= ray.direction * static_cast<float>(scene.radius * 128.0);
    ray.anchor.w = 0.0F;
    rays.push_back(ray);
  }
  const std::vector<CastHit> expected = cast(scene, settings, rays, RayQueue::kSteps);
  scene.bvh = build_bvh(scene);
  const std::vector<CastHit> hits = cast(scene, settings, rays, RayQueue::kSteps);
  std::size_t count = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    count += hits[i].triangle != NO_TRIANGLE ? 1 : 0;
    EXPECT_EQ(std::memcmp(&hits[i], &expected[i], offsetof(CastHit, evaluations)), 0) << i;
  }
  EXPECT_GT(count, 300U);
}

TEST_F(Queue, TheBisectionSeesEveryTriangleOnceInSeveralPasses) {
  // At rank 60 a pass takes 1015 triangles, so the 1280 of this model take two passes.
  const Mesh mesh = stress::sphere(3);
  const BakedScene scene = bake(mesh, {SURFACE_FLAT, 0.0});
  ASSERT_EQ(scene.triangles.size(), 1280U);
  TraceSettings settings = test::framed(mesh, scene, 8, 8, 60);
  std::vector<CastRay> rays;
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const stress::SurfacePoint middle = stress::point_at(scene, t, glm::dvec3(1.0 / 3.0));
    rays.push_back(stress::ray_through(scene, middle.position, -middle.normal));
  }
  const std::vector<CastHit> hits = cast(scene, settings, rays, RayQueue::kSteps);
  for (uint32_t t = 0; t < hits.size(); ++t) EXPECT_EQ(hits[t].triangle, t);
}

}  // namespace
}  // namespace trisect
