// The kernel as C++ ends within its bound of evaluations whatever numbers it is fed.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "app/bake/subpatch_bounds.h"
#include "app/base/parallel_rows.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/trace_settings.h"
#include "app/stress/stress_scenes.h"
#include "app/surface/surface_float.h"
#include "tests/support/garbage.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// A ray straight at a patch whose bounds say nothing visits every node: the bound is reached in
// order of magnitude, and holds.
TEST(Garbage, BoundsThatLeaveOutNothingAreSearchedToTheEnd) {
  BakedScene scene =
      bake_with_subpatches(stress::leaning_patch(30.0), {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  scene.subpatches.resize(1);
  scene.subpatches[0].skip = 0;
  scene.subpatches[0].cone.w = NO_CONE;
  scene.subpatches[0].corner.w = 1e15F;
  scene.subpatches[0].edge.w = 1e15F;
  scene.subpatches[0].gradient_lipschitz = 1e30F;
  TraceSettings settings;
  settings.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45.0};
  const std::vector<CastRay> rays{{vec4(0, 0, 5, -10), vec4(0, 0, -1, 0)}};
  const std::vector<CastHit> hits =
      cast_on_cpu(scene, make_params(scene, settings), SOLVER_ROBUST, rays);
  EXPECT_GT(hits[0].evaluations, in_float::MOST_EVALUATIONS / 20);
  EXPECT_LE(hits[0].evaluations, in_float::MOST_EVALUATIONS);
}

// A ray or a patch of NaNs leaves out no node, so none may be begun with.
TEST(Garbage, NansAreNotSearched) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const BakedScene good = test::two_subpatches({SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  TraceSettings settings;
  settings.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45.0};
  const TraceParams params = make_params(good, settings);
  // Newton's steps on the whole, and one visit.
  constexpr uint most = 2 * (in_float::ONCE_STEPS + 1);
  const std::vector<CastRay> rays{{vec4(nan, 0, 5, -10), vec4(0, 0, -1, 0)},
                                  {vec4(0, 0, 5, -10), vec4(0, nan, -1, 0)}};
  for (const CastHit& hit : cast_on_cpu(good, params, SOLVER_ROBUST, rays)) {
    EXPECT_LE(hit.evaluations, most);
  }
  BakedScene bad = good;
  for (Triangle& tri : bad.triangles) tri.Normal[1].x = nan;
  const std::vector<CastRay> straight{{vec4(0, 0, 5, -10), vec4(0, 0, -1, 0)}};
  EXPECT_LE(cast_on_cpu(bad, params, SOLVER_ROBUST, straight)[0].evaluations, most);
}

TEST(Garbage, EndsOnTheCpuWithinItsBoundOfEvaluations) {
  std::mt19937 random(5);
  for (const SurfaceChoice& choice :
       std::vector<SurfaceChoice>{{SURFACE_FLAT, 0.65, SHELL_NORMAL},
                                  {SURFACE_PHONG, 0.65, SHELL_NORMAL},
                                  {SURFACE_PHONG, 0.65, SHELL_HEIGHT},
                                  {SURFACE_SPHERE, 0.65, SHELL_NORMAL},
                                  {SURFACE_SPHERE, 0.65, SHELL_HEIGHT}}) {
    const BakedScene good = test::two_subpatches(choice);
    for (const test::Garbage garbage : test::kAllGarbage) {
      for (int round = 0; round < 2; ++round) {
        BakedScene scene = good;
        TraceSettings settings;
        settings.width = 1;
        settings.height = 1;
        settings.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45.0};
        TraceParams params = make_params(scene, settings);
        std::mt19937_64 directions(7);
        std::vector<CastRay> rays = stress::rays_at_surface(scene, directions, 1);
        test::spoil(garbage, random, scene);
        test::spoil(garbage, random, params);
        test::spoil(garbage, random, rays);
        const std::string what = std::string(test::garbage_name(garbage)) + " on " +
                                 surface_name(choice.surface) + ", " + shell_name(choice.shell);
        for (const CastHit& hit : cast_on_cpu(scene, params, SOLVER_ROBUST, rays)) {
          EXPECT_LE(hit.evaluations, test::most_evaluations(scene)) << what;
        }
        for (const CastHit& hit : cast_on_cpu(scene, params, SOLVER_BISECT, rays)) {
          EXPECT_LE(hit.evaluations, params.triangle_count * (params.rank - 1)) << what;
        }
        Frame frame;
        KernelChoice kernels{SOLVER_ROBUST, true, true};
        kernels.shadows = true;
        EXPECT_TRUE(trace_on_cpu(scene, params, kernels, frame)) << what;
        for (const PixelAovs& aovs : frame.aovs) {
          EXPECT_LE(aovs.evaluations, 2 * test::most_evaluations(scene)) << what;
        }
      }
    }
  }
}

// One ray that takes seconds, in a frame of one row.
TEST(Garbage, ARayOnItsWayIsInterrupted) {
  const Mesh mesh = stress::leaning_patch(30.0);
  BakedScene scene = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  SubpatchBounds nothing = scene.subpatches[0];
  nothing.skip = 0;
  nothing.cone.w = NO_CONE;
  nothing.ball.w = 1e15F;
  nothing.corner.w = 1e15F;
  nothing.edge.w = 1e15F;
  nothing.gradient_lipschitz = 1e30F;
  scene.subpatches.assign(1000, nothing);
  const TraceParams params = make_params(scene, test::framed(mesh, scene, 1, 1, 10));
  const auto start = std::chrono::steady_clock::now();
  Frame frame;
  EXPECT_FALSE(trace_on_cpu(scene, params, {SOLVER_ROBUST, true, true}, frame,
                            [](uint32_t) { return false; }));
  // Without interruption it takes an hour. progress() is asked after 0.2 s at the latest, a ray
  // then takes some hundredths of a second to notice; the rest is for a busy machine.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(ParallelRows, TellRowsOnTheirWayThatTheyAreStopped) {
  std::atomic<int> ended = 0;
  const auto endless = [&](uint32_t, const Stopped& stopped) {
    while (!stopped) std::this_thread::yield();
    ++ended;
  };
  EXPECT_FALSE(parallel_rows(1, endless, [](uint32_t) { return false; }));
  EXPECT_EQ(ended, 1);
  EXPECT_THROW(parallel_rows(1, endless, [](uint32_t) -> bool { throw std::runtime_error("no"); }),
               std::runtime_error);
  EXPECT_EQ(ended, 2);
}

}  // namespace
}  // namespace trisect
