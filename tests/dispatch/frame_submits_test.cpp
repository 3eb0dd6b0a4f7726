// A frame is the same in one submit as in many.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/dispatch/workgroups.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

class FrameSubmits : public test::GpuTest {};

struct Framed {
  BakedScene scene;
  TraceParams params;
};

Framed framed(const Mesh& mesh, const SurfaceChoice& choice, uint32_t width, uint32_t height) {
  Framed framed{bake_with_subpatches(mesh, choice), {}};
  framed.scene.bvh = build_bvh(framed.scene);
  TraceSettings settings = test::framed(mesh, framed.scene, width, height, 60);
  settings.solver = SOLVER_ROBUST;
  framed.params = make_params(framed.scene, settings);
  return framed;
}

// Renders a frame, which takes many small submits as nothing is known of their cost, then traces it
// anew. Expects all frames to be the same. Returns the fewest submits of one.
uint64_t fewest_submits(const Framed& framed, const KernelChoice& choice,
                        std::size_t buffer_limit = kNoLimit) {
  VulkanTracer tracer(test::validated_device(), framed.scene, framed.params.width,
                      framed.params.height, choice, buffer_limit);
  Frame first;
  tracer.render(framed.params, first);
  uint64_t fewest = std::numeric_limits<uint64_t>::max();
  // A busy machine can hold up any submit, and the next ones are smaller then.
  for (int run = 0; run < 8; ++run) {
    const uint64_t before = tracer.submits();
    EXPECT_TRUE(tracer.trace(framed.params));
    fewest = std::min(fewest, tracer.submits() - before);
    Frame frame;
    tracer.fetch(framed.params, frame);
    test::expect_equal(first, frame, "run " + std::to_string(run));
  }
  return fewest;
}

TEST_F(FrameSubmits, AreOneIfThatIsEnough) {
  const Framed teapot = framed(test::load_asset("teapot"), {SURFACE_PHONG, 0.65}, 59, 43);
  for (const Accel accel : {Accel::list, Accel::tiles, Accel::bvh}) {
    EXPECT_EQ(fewest_submits(teapot, {SOLVER_ROBUST, true, true, accel}), 1U) << accel_name(accel);
    EXPECT_EQ(fewest_submits(teapot, {SOLVER_ROBUST, true, true, accel, true}), 1U)
        << accel_name(accel) << ", shadows";
  }
}

// The bytes of a queue with places for the rays of so many workgroups.
constexpr std::size_t queue_of(uint32_t groups) {
  return RayQueue::kBytes * groups * kGroupRays;
}

// More workgroups than the queue has places for: several parts go into a submit.
TEST_F(FrameSubmits, HaveSeveralParts) {
  const Framed relief = framed(test::load_asset("relief"), {SURFACE_PHONG, 0.65}, 96, 80);
  ASSERT_EQ(groups_of_band(96, 0, 80).end, 120U);
  for (const Accel accel : {Accel::tiles, Accel::bvh}) {
    const KernelChoice choice{SOLVER_ROBUST, false, false, accel, true};
    EXPECT_EQ(fewest_submits(relief, choice, queue_of(50)), 1U) << accel_name(accel);
  }
}

// Where rays are left after a part's passes, as those of the bisection here after one, which tests
// 1015 triangles at rank 60, the parts after it have to wait for the host to finish them.
TEST_F(FrameSubmits, FinishThePassesOfEveryPart) {
  const Framed sphere = framed(stress::sphere(3), {SURFACE_FLAT, 0.0}, 96, 80);
  ASSERT_EQ(sphere.scene.triangles.size(), 1280U);
  EXPECT_EQ(fewest_submits(sphere, {SOLVER_BISECT, false, false, Accel::list}, queue_of(50)),
            2U * 3U);
}

}  // namespace
}  // namespace trisect
