// Accelerations change the time of a frame and what is uploaded for it, but not a bit of the frame;
// and their kernels are in the list of shaders/CMakeLists.txt.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/ray_queue.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"
#include "vk/result.h"

namespace trisect {
namespace {

class Acceleration : public test::GpuTest {};

// The accelerations, but for the list, that the device has.
std::vector<Accel> fast_accels(const gpu::Device& device = test::validated_device()) {
  std::vector<Accel> accels{Accel::tiles, Accel::bvh};
  if (device.has_ray_query()) accels.push_back(Accel::rayquery);
  return accels;
}

Frame trace(const BakedScene& scene, const TraceSettings& settings, Accel accel,
            std::size_t buffer_limit = kNoLimit,
            const gpu::Device& device = test::validated_device()) {
  VulkanTracer tracer = test::tracer_of(scene, settings.width, settings.height,
                                        {SOLVER_ROBUST, true, false, accel}, buffer_limit, device);
  Frame frame;
  tracer.render(make_params(scene, settings), frame);
  return frame;
}

// Every acceleration against the list.
void expect_all_equal(BakedScene scene, const TraceSettings& settings, const std::string& what,
                      std::size_t buffer_limit = kNoLimit) {
  scene.bvh = build_bvh(scene);
  const Frame list = trace(scene, settings, Accel::list);
  for (const Accel accel : fast_accels()) {
    test::expect_equal(list, trace(scene, settings, accel, buffer_limit),
                       what + " " + accel_name(accel));
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
      // Its sphere surface leaves the definition in places.
      const bool unusual = choice.surface == SURFACE_SPHERE && name == "teapot";
      if (!usual && !unusual && name != "sphere-20" && name != "cube") continue;
      const BakedScene scene = bake_with_subpatches(mesh, choice);
      const TraceSettings settings = small(mesh, scene);
      expect_all_equal(scene, settings,
                       name + " " + std::to_string(choice.surface) + std::to_string(choice.shell));
    }
  }
}

// What no quadratic follows has a search of its own.
TEST_F(Acceleration, IsTheListToTheBitWhereTheSurfaceIsNonsmooth) {
  const Mesh mesh = test::wild_patches(8);
  const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_SPHERE, 0.0, SHELL_NORMAL});
  ASSERT_TRUE(has_nonsmooth(scene));
  expect_all_equal(scene, small(mesh, scene), "wild patches");
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

TEST_F(Acceleration, HandlesManySubpatchesInOneTile) {
  const Mesh mesh = stress::sphere(5);
  const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  // The whole model in a few tiles.
  TraceSettings settings = test::framed(mesh, scene, 40, 24, 10);
  settings.solver = SOLVER_ROBUST;
  ASSERT_GT(scene.subpatches.size(), 15U * TILE_CAPACITY);
  expect_all_equal(scene, settings, "");
}

// Triangles one behind the other, all of which fill the image, seen from the last one's side.
Mesh layers_of(uint32_t count) {
  Mesh mesh;
  for (uint32_t k = 0; k < count; ++k) {
    const double z = 0.0001 * k;
    for (const glm::dvec2& at : {glm::dvec2(-3, -2), glm::dvec2(3, -2), glm::dvec2(0, 3)}) {
      mesh.positions.emplace_back(at, z + 0.0001 * at.x);
      mesh.normals.emplace_back(0, 0, 1);
    }
    mesh.triangles.push_back({{3 * k, 3 * k + 1, 3 * k + 2}, {3 * k, 3 * k + 1, 3 * k + 2}});
  }
  return mesh;
}

// More entries in the lists of tiles than a buffer may hold: some tiles have no list.
TEST_F(Acceleration, HandlesListsThatDoNotFit) {
  constexpr uint32_t layers = 1000;
  const Mesh mesh = layers_of(layers);
  const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_FLAT, 0.0, SHELL_NORMAL});
  TraceSettings settings = test::framed(mesh, scene, 80, 72, 10);
  settings.solver = SOLVER_ROBUST;
  // The triangles are all that is seen.
  settings.camera.fov = 10.0;
  const std::size_t limit = layers * sizeof(Triangle);
  // A band is of 6 rows of 10 tiles.
  ASSERT_EQ(limit / (80 * sizeof(PixelAovs)) / TILE_SIZE, 6U);
  ASSERT_LT(limit, std::size_t{6} * 10 * layers * sizeof(uint32_t));
  expect_all_equal(scene, settings, "", limit);
}

// A tree in which every node has a subpatch, the first one of the scene first, and a node below it,
// the last two subpatches. inner: which child the node is; the subpatch is in the opposite octant.
std::vector<BvhNode> chain_of(BakedScene scene, uint32_t inner) {
  const uint32_t outer = inner ^ (BVH_CHILDREN - 1);
  const auto count = static_cast<uint32_t>(scene.subpatches.size());
  scene.bvh.clear();
  for (uint32_t n = 0; n + 1 < count; ++n) {
    BvhNode node{};
    node.parent = n == 0 ? BVH_END : (n - 1) * BVH_PLACES + inner;
    node.children = 1U << inner | 1U << outer;
    node.links[outer] = BVH_LEAF + n;
    node.links[inner] = n + 2 < count ? (n + 1) * BVH_PLACES : BVH_LEAF + count - 1;
    scene.bvh.push_back(node);
  }
  return refitted_bvh(scene, scene).value();
}

// Where a ray meets all of a tree, nodes above wait for what is below them: more than the stack of
// a ray can hold, which leaves such a ray to another kernel, and as many as there may be.
TEST_F(Acceleration, TakesDeepTrees) {
  const gpu::Device alone(test::validated_instance(), "", VK_NULL_HANDLE, 0);
  for (const uint32_t levels : {12U, uint32_t{BVH_LEVELS}}) {
    const Mesh mesh = layers_of(levels);
    BakedScene scene = bake_with_subpatches(mesh, {SURFACE_FLAT, 0.0, SHELL_NORMAL});
    ASSERT_EQ(scene.subpatches.size(), levels);
    TraceSettings settings = small(mesh, scene);
    // On the side of the first octant and of the first triangle.
    settings.camera.eye = scene.origin * 2.0 - settings.camera.eye;
    const Frame list = trace(scene, settings, Accel::list);
    for (const uint32_t inner : {0U, BVH_CHILDREN - 1}) {
      scene.bvh = chain_of(scene, inner);
      const std::string what = std::to_string(levels) + ", " + std::to_string(inner) + ", ";
      test::expect_equal(list, trace(scene, settings, Accel::bvh), what + "packets");
      const Frame rays = trace(scene, settings, Accel::bvh, kNoLimit, alone);
      test::expect_equal(list, rays, what + "rays");
      if (inner != 0) {
        EXPECT_EQ(rays.queued_rays, 0U) << levels;
      } else {
        EXPECT_GE(rays.queued_rays, list.hits()) << levels;
      }
    }
  }
}

// A subpatch that takes more steps than a ray has in one submit.
TEST_F(Acceleration, EndsLongSearches) {
  const Mesh mesh = stress::plain_patch(
      {glm::dvec3(-0.958, -0.287, 0.0017), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)});
  const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  const TraceSettings settings = small(mesh, scene);
  VulkanTracer tracer(test::validated_device(), scene, settings.width, settings.height,
                      {.aovs = true, .counts = true});
  Frame frame;
  tracer.render(make_params(scene, settings), frame);
  uint most = 0;
  for (const PixelAovs& pixel : frame.aovs) most = std::max(most, pixel.evaluations);
  ASSERT_GT(most, RayQueue::kSteps);
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

TEST_F(Acceleration, RayQueriesAreThereOrRefused) {
  BakedScene scene =
      bake_with_subpatches(test::load_asset("sphere-20"), {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  scene.bvh = build_bvh(scene);
  const KernelChoice choice{.solver = SOLVER_ROBUST, .accel = Accel::rayquery};
  if (test::validated_device().has_ray_query()) {
    const VulkanTracer tracer(test::validated_device(), scene, 8, 8, choice);
    // The bytes of the acceleration structure count; each of its boxes takes 24 bytes.
    EXPECT_GT(tracer.scene_bytes(), scene.triangles.size() * sizeof(Triangle) +
                                        scene.subpatches.size() * (sizeof(SubpatchBounds) + 24) +
                                        scene.bvh.size() * sizeof(BvhNode));
  } else {
    EXPECT_THROW(VulkanTracer(test::validated_device(), scene, 8, 8, choice), gpu::Error);
  }
}

// Subgroups of every size that the device lets kernels ask for, and none.
TEST_F(Acceleration, WorksWithSubgroupsOfAnySize) {
  BakedScene scene =
      bake_with_subpatches(test::load_asset("teapot"), {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  scene.bvh = build_bvh(scene);
  const TraceSettings settings = small(test::load_asset("teapot"), scene);
  const Frame list = trace(scene, settings, Accel::list);
  const gpu::Instance& instance = test::validated_instance();
  const gpu::SubgroupSupport& support = test::validated_device().capabilities().subgroups;
  std::vector<uint32_t> sizes = support.sizes();
  sizes.push_back(0);
  std::string tried;
  for (const uint32_t size : sizes) {
    const gpu::Device device(instance, "", VK_NULL_HANDLE, size);
    ASSERT_EQ(device.subgroup_size(), size);
    const std::string what = "subgroups of " + std::to_string(size);
    tried += " " + std::to_string(size);
    test::expect_equal(list, trace(scene, settings, Accel::bvh, kNoLimit, device), what + ", bvh");
    if (device.has_addresses()) {
      const std::size_t limit = scene.triangles.size() * sizeof(Triangle) - 1;
      test::expect_equal(list, trace(scene, settings, Accel::bvh, limit, device),
                         what + ", addresses");
    }
    if (size == 0) {
      EXPECT_THROW(trace(scene, settings, Accel::tiles, kNoLimit, device), gpu::Error);
    } else {
      test::expect_equal(list, trace(scene, settings, Accel::tiles, kNoLimit, device),
                         what + ", tiles");
    }
  }
  RecordProperty("subgroup_sizes", tried);
  EXPECT_THROW(gpu::Device(instance, "", VK_NULL_HANDLE, 3), gpu::Error);
}

// Of a device of Vulkan 1.1 all is by extensions, of a newer one much is not.
TEST_F(Acceleration, WorksWithEveryVersionOfVulkan) {
  BakedScene scene =
      bake_with_subpatches(test::load_asset("teapot"), {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  scene.bvh = build_bvh(scene);
  const TraceSettings settings = small(test::load_asset("teapot"), scene);
  const std::size_t limit = scene.triangles.size() * sizeof(Triangle) - 1;
  const Frame list = trace(scene, settings, Accel::list);
  for (const uint32_t version : {VK_API_VERSION_1_1, VK_API_VERSION_1_2, VK_API_VERSION_1_3}) {
    const gpu::Instance instance(test::validates(), {}, version);
    {
      const gpu::Device device(instance, "");
      const std::string what = "Vulkan 1." + std::to_string(VK_API_VERSION_MINOR(version));
      EXPECT_LE(device.capabilities().version, version);
      for (const Accel accel : fast_accels(device)) {
        const Frame frame = trace(scene, settings, accel, kNoLimit, device);
        test::expect_equal(list, frame, what + ", " + accel_name(accel));
      }
      if (device.has_addresses()) {
        test::expect_equal(list, trace(scene, settings, Accel::bvh, limit, device),
                           what + ", addresses");
      }
    }
    for (const std::string& message : instance.log().messages()) ADD_FAILURE() << message;
  }
}

// Where the tree is not needed, a scene that has one takes no more memory than one that has none.
TEST_F(Acceleration, UploadsTheTreeOnlyWhereItIsNeeded) {
  const BakedScene without =
      bake_with_subpatches(test::load_asset("sphere-80"), {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  BakedScene with = without;
  with.bvh = build_bvh(with);
  const std::size_t tree_bytes = with.bvh.size() * sizeof(BvhNode);
  const auto bytes = [](const BakedScene& scene, Accel accel, bool shadows) {
    const KernelChoice choice{.solver = SOLVER_ROBUST, .accel = accel, .shadows = shadows};
    return VulkanTracer(test::validated_device(), scene, 8, 8, choice).scene_bytes();
  };
  EXPECT_EQ(bytes(with, Accel::list, false), bytes(without, Accel::list, false));
  EXPECT_EQ(bytes(with, Accel::list, true), bytes(without, Accel::list, false));
  const std::size_t tiles_bytes = bytes(without, Accel::tiles, false);
  EXPECT_EQ(bytes(with, Accel::tiles, false), tiles_bytes);
  // Without the tree its binding has one entry.
  EXPECT_EQ(bytes(with, Accel::tiles, true), tiles_bytes - sizeof(BvhNode) + tree_bytes);
  EXPECT_EQ(bytes(with, Accel::bvh, false),
            bytes(without, Accel::list, false) - sizeof(BvhNode) + tree_bytes);
}

// What is in the memory of a tree that is not there would be taken for one.
TEST_F(Acceleration, WithoutTheTreeThatItNeedsIsRefused) {
  const BakedScene scene =
      bake_with_subpatches(test::load_asset("cube"), {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  const auto make = [&](Accel accel, bool shadows) {
    const KernelChoice choice{.solver = SOLVER_ROBUST, .accel = accel, .shadows = shadows};
    VulkanTracer(test::validated_device(), scene, 8, 8, choice);
  };
  EXPECT_THROW(make(Accel::tiles, true), std::logic_error);
  EXPECT_THROW(make(Accel::bvh, false), std::logic_error);
  EXPECT_NO_THROW(make(Accel::tiles, false));
  EXPECT_NO_THROW(make(Accel::list, true));
}

// With a limit that is less than the model's buffers take, they cannot be bound.
TEST_F(Acceleration, ReachesLargeBuffersByTheirAddresses) {
  BakedScene scene =
      bake_with_subpatches(test::load_asset("teapot"), {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  scene.bvh = build_bvh(scene);
  const TraceSettings settings = small(test::load_asset("teapot"), scene);
  const std::size_t limit = scene.triangles.size() * sizeof(Triangle) - 1;
  ASSERT_TRUE(test::validated_device().has_addresses());
  test::expect_equal(trace(scene, settings, Accel::list), trace(scene, settings, Accel::bvh, limit),
                     "");
  EXPECT_THROW(trace(scene, settings, Accel::list, limit), gpu::Error);
}

}  // namespace
}  // namespace trisect
