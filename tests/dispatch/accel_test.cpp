// Accelerations change the time of a frame, not a bit of it.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"
#include "vk/result.h"

namespace trisect {
namespace {

class Acceleration : public test::GpuTest {};

// Those beside the list that the device has.
std::vector<Accel> fast_ways() {
  std::vector<Accel> ways{Accel::tiles, Accel::bvh};
  if (test::validated_device().has_ray_query()) ways.push_back(Accel::rayquery);
  return ways;
}

Frame trace(const BakedScene& scene, const TraceSettings& settings, Accel accel,
            std::size_t buffer_limit = std::numeric_limits<std::size_t>::max()) {
  VulkanTracer tracer(test::validated_device(), scene, settings.width, settings.height,
                      {SOLVER_ROBUST, true, false, accel}, buffer_limit);
  Frame frame;
  tracer.render(make_params(scene, settings), frame);
  return frame;
}

void expect_equal(const Frame& a, const Frame& b, const std::string& what) {
  ASSERT_GT(a.hits(), 0U) << what;
  ASSERT_EQ(a.aovs.size(), b.aovs.size());
  EXPECT_EQ(std::memcmp(a.colors.data(), b.colors.data(), a.colors.size() * sizeof(vec4)), 0)
      << what;
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.aovs.size(); ++i) {
    const PixelAovs& p = a.aovs[i];
    const PixelAovs& q = b.aovs[i];
    // The work done is what may differ.
    const bool same = p.normal_z == q.normal_z && p.geometric_u == q.geometric_u && p.v == q.v &&
                      p.triangle == q.triangle;
    if (!same) ++different;
  }
  EXPECT_EQ(different, 0U) << what;
}

// Every acceleration against the list.
void expect_all_equal(BakedScene scene, const TraceSettings& settings, const std::string& what,
                      std::size_t buffer_limit = std::numeric_limits<std::size_t>::max()) {
  scene.bvh = build_bvh(scene);
  const Frame list = trace(scene, settings, Accel::list);
  for (const Accel accel : fast_ways()) {
    expect_equal(list, trace(scene, settings, accel, buffer_limit), what + " " + accel_name(accel));
  }
}

// The image's sides are no multiples of a tile's.
TraceSettings small(const Mesh& mesh, const BakedScene& scene) {
  TraceSettings settings = test::framed(mesh, scene, 59, 43, 10);
  settings.solver = SOLVER_ROBUST;
  return settings;
}

TEST_F(Acceleration, IsTheListToTheBit) {
  for (const std::string& name : test::asset_names()) {
    // Like the teapot, only larger.
    if (name == "teapot-1000") continue;
    const Mesh mesh = test::load_asset(name);
    for (const SurfaceChoice& choice : {SurfaceChoice{SURFACE_FLAT, 0.0, SHELL_NORMAL},
                                        SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_NORMAL},
                                        SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_HEIGHT},
                                        SurfaceChoice{SURFACE_SPHERE, 0.0, SHELL_NORMAL}}) {
      const bool usual = choice.surface == SURFACE_PHONG && choice.shell == SHELL_NORMAL;
      // With kinks, on the sphere surface.
      const bool unusual = choice.surface == SURFACE_SPHERE && name == "teapot";
      if (!usual && !unusual && name != "sphere-20" && name != "cube") continue;
      const BakedScene scene = bake_with_subpatches(mesh, choice);
      const TraceSettings settings = small(mesh, scene);
      expect_all_equal(scene, settings,
                       name + " " + std::to_string(choice.surface) + std::to_string(choice.shell));
    }
  }
}

TEST_F(Acceleration, SeesWhatIsAroundAndBehindTheEye) {
  const Mesh mesh = test::load_asset("torus");
  const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  TraceSettings settings = small(mesh, scene);
  for (const double fov : {45.0, 170.0}) {
    settings.camera.fov = fov;
    // In the hole, within the tube, and so far away that the model is a few pixels.
    for (const glm::dvec3& eye :
         {glm::dvec3(0.01, 0.02, 0.03), glm::dvec3(scene.extent * 0.6, 0.0, 0.01),
          glm::dvec3(scene.extent * 20.0, 1.0, 2.0)}) {
      settings.camera.eye = scene.origin + eye;
      settings.camera.target = scene.origin + glm::dvec3(0.3, 0.1, -0.2) * scene.extent;
      expect_all_equal(scene, settings, std::to_string(fov) + " " + std::to_string(eye.x));
    }
  }
}

TEST_F(Acceleration, BearsManyPartsInOneTile) {
  const Mesh mesh = stress::sphere(4);
  const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  // The whole model in a few tiles.
  TraceSettings settings = test::framed(mesh, scene, 40, 24, 10);
  settings.solver = SOLVER_ROBUST;
  ASSERT_GT(scene.subpatches.size(), 15U * TILE_CAPACITY);
  expect_all_equal(scene, settings, "");
}

TEST_F(Acceleration, WorksInEveryBandOfAnImage) {
  const Mesh mesh = test::load_asset("sphere-80");
  const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_FLAT, 0.0, SHELL_NORMAL});
  const TraceSettings settings = small(mesh, scene);
  // Eight rows of 59 pixels of 48 bytes: six bands.
  constexpr std::size_t limit = 26000;
  expect_all_equal(scene, settings, "", limit);
}

TEST_F(Acceleration, OfTheDevicesOwnIsThereOrRefused) {
  BakedScene scene =
      bake_with_subpatches(test::load_asset("sphere-20"), {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  scene.bvh = build_bvh(scene);
  const KernelChoice choice{.solver = SOLVER_ROBUST, .accel = Accel::rayquery};
  if (test::validated_device().has_ray_query()) {
    const VulkanTracer tracer(test::validated_device(), scene, 8, 8, choice);
    // Its structure counts, beside the boxes that it is made of.
    EXPECT_GT(tracer.scene_bytes(), scene.triangles.size() * sizeof(Triangle) +
                                        scene.subpatches.size() * (sizeof(SubpatchBounds) + 24) +
                                        scene.bvh.size() * sizeof(BvhEntry));
  } else {
    EXPECT_THROW(VulkanTracer(test::validated_device(), scene, 8, 8, choice), gpu::Error);
  }
}

// Buffers that may not be bound, here for a limit of less than the model takes.
TEST_F(Acceleration, ReachesLargeBuffersByTheirAddresses) {
  BakedScene scene =
      bake_with_subpatches(test::load_asset("teapot"), {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  scene.bvh = build_bvh(scene);
  const TraceSettings settings = small(test::load_asset("teapot"), scene);
  const std::size_t limit = scene.triangles.size() * sizeof(Triangle) - 1;
  ASSERT_TRUE(test::validated_device().has_addresses());
  expect_equal(trace(scene, settings, Accel::list), trace(scene, settings, Accel::bvh, limit), "");
  EXPECT_THROW(trace(scene, settings, Accel::list, limit), gpu::Error);
}

}  // namespace
}  // namespace trisect
