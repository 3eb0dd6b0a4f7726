// The Vulkan kernels end within their bound of evaluations whatever numbers they are fed.
#include <gtest/gtest.h>

#include <string>

#include "app/dispatch/ray_caster.h"
#include "app/dispatch/trace_settings.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/garbage.h"
#include "tests/support/gpu.h"

namespace trisect {
namespace {

class GarbageOnTheDevice : public test::GpuTest {};

TraceParams few_pixels(const BakedScene& scene) {
  TraceSettings settings;
  settings.width = 4;
  settings.height = 2;
  settings.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45.0};
  return make_params(scene, settings);
}

// Frames by one way, with every kind of garbage.
void expect_to_end(const SurfaceChoice& surface, Accel accel, bool shadows) {
  std::mt19937 random(5);
  KernelChoice choice{SOLVER_ROBUST, true, true, accel};
  choice.shadows = shadows;
  const BakedScene good = test::two_subpatches(surface);
  for (const test::Garbage garbage : test::kAllGarbage) {
    SCOPED_TRACE(test::garbage_name(garbage));
    BakedScene scene = good;
    TraceParams params = few_pixels(scene);
    test::spoil(garbage, random, scene);
    test::spoil(garbage, random, params);
    VulkanTracer tracer = test::tracer_of(scene, params.width, params.height, choice);
    Frame frame;
    ASSERT_TRUE(tracer.render(params, frame));
    for (const PixelAovs& aovs : frame.aovs) {
      ASSERT_LE(aovs.evaluations, 2 * test::most_evaluations(scene));
    }
  }
}

constexpr SurfaceChoice kPhongHeight{SURFACE_PHONG, 0.65, SHELL_HEIGHT};
constexpr SurfaceChoice kSphereNormal{SURFACE_SPHERE, 0.65, SHELL_NORMAL};

TEST_F(GarbageOnTheDevice, EndsWithinItsBoundByTheList) {
  expect_to_end(kPhongHeight, Accel::list, true);
  expect_to_end(kSphereNormal, Accel::list, true);
}

TEST_F(GarbageOnTheDevice, EndsWithinItsBoundByTiles) {
  expect_to_end(kPhongHeight, Accel::tiles, false);
  expect_to_end(kSphereNormal, Accel::tiles, false);
}

TEST_F(GarbageOnTheDevice, EndsWithinItsBoundByTheTree) {
  expect_to_end(kPhongHeight, Accel::bvh, true);
  expect_to_end(kSphereNormal, Accel::bvh, true);
}

TEST_F(GarbageOnTheDevice, EndsForCastRays) {
  std::mt19937 random(6);
  for (const bool tree : {false, true}) {
    BakedScene good = test::two_subpatches({SURFACE_PHONG, 0.65, SHELL_HEIGHT});
    if (!tree) good.bvh.clear();
    const auto kernel = RayCaster::kernel_for(test::validated_device(), good.choice, SOLVER_ROBUST,
                                              {true, true, tree});
    for (const test::Garbage garbage : test::kAllGarbage) {
      BakedScene scene = good;
      TraceParams params = few_pixels(scene);
      std::mt19937_64 directions(7);
      std::vector<CastRay> rays = stress::rays_at_surface(scene, directions, 8);
      test::spoil(garbage, random, scene);
      test::spoil(garbage, random, params);
      test::spoil(garbage, random, rays);
      RayCaster caster(test::validated_device(), scene, params, SOLVER_ROBUST, kernel);
      for (const CastHit& hit : caster.cast(rays)) {
        ASSERT_LE(hit.evaluations, test::most_evaluations(scene)) << test::garbage_name(garbage);
      }
    }
  }
}

}  // namespace
}  // namespace trisect
