// The kernels under the validation layer's GPU-assisted checks: it adds to each shader what looks
// for reads and writes outside of buffers, by binding or by address. Kernels take ten times as long
// to compile then (Mesa 25: thirty times), so that there is one small picture for each of them, and
// those of several kernels are among the slow tests.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/buffers/kernels.h"
#include "app/dispatch/ray_caster.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"
#include "vk/commands.h"

namespace trisect {
namespace {

constexpr uint32_t kSide = 16;

// The layer reads the variable when an instance is made.
class GpuAssistedInstance {
 public:
  GpuAssistedInstance() {
    setenv("VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT", 1);
    instance_.emplace(true);
    unsetenv("VK_LAYER_ENABLES");
  }
  [[nodiscard]] const gpu::Instance& get() const { return *instance_; }

 private:
  std::optional<gpu::Instance> instance_;
};

class GpuAssisted : public ::testing::Test {
 protected:
  GpuAssisted() : device_(instance_.get(), "") {
    scene_ = bake_with_subpatches(mesh_, {SURFACE_PHONG, 0.65, SHELL_NORMAL});
    scene_.bvh = build_bvh(scene_);
  }

  void TearDown() override {
    for (const std::string& message : take_messages()) ADD_FAILURE() << "validation: " << message;
  }

  std::vector<std::string> take_messages() {
    std::vector<std::string> messages = instance_.get().log().messages();
    instance_.get().log().clear();
    return messages;
  }

  void expect_hits(const KernelChoice& choice, std::size_t buffer_limit = kNoLimit) {
    TraceSettings settings = framed_settings(mesh_, scene_, kSide, kSide);
    VulkanTracer tracer(device_, scene_, kSide, kSide, choice, buffer_limit);
    Frame frame;
    tracer.render(make_params(scene_, settings), frame);
    EXPECT_GT(frame.hits(), kSide * kSide / 4);
  }

  GpuAssistedInstance instance_;
  gpu::Device device_;
  Mesh mesh_ = test::load_asset("sphere-20");
  BakedScene scene_;
};

// The other tests rely on it.
TEST_F(GpuAssisted, ChecksSeeAWriteOutsideOfABuffer) {
  const gpu::Kernel kernel = make_kernel(device_, "clear_image", {});
  const gpu::Buffer params(device_, sizeof(TraceParams), gpu::Memory::host, "parameters");
  const gpu::Buffer too_small(device_, (kSide * kSide - 1) * sizeof(vec4), gpu::Memory::device,
                              "one pixel short");
  TraceParams image{};
  image.width = kSide;
  image.height = kSide;
  std::memcpy(params.bytes().data(), &image, sizeof(image));
  const gpu::DescriptorSet descriptors(device_, kernel, {&params, &too_small});
  gpu::Commands commands(device_);
  commands.begin();
  commands.dispatch(kernel, descriptors, {}, kSide / TILE_SIZE, kSide / TILE_SIZE);
  commands.submit_and_wait();
  const std::vector<std::string> messages = take_messages();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages[0].find("out of bounds"), std::string::npos) << messages[0];
}

TEST_F(GpuAssisted, ChecksFindNothingByTheList) {
  expect_hits({.aovs = true, .counts = true});
}

#ifdef TRISECT_SLOW
TEST_F(GpuAssisted, ChecksFindNothingByTilesAndInShadows) {
  expect_hits({.accel = Accel::tiles, .shadows = true});
}

TEST_F(GpuAssisted, ChecksFindNothingByAddresses) {
  ASSERT_TRUE(device_.has_addresses());
  // A limit that the triangles do not fit in, and a frame does.
  const std::size_t limit = scene_.triangles.size() * sizeof(Triangle) - 1;
  ASSERT_GE(limit, sizeof(vec4) * kSide * TILE_SIZE);
  expect_hits({.accel = Accel::bvh}, limit);
  if (device_.has_ray_query()) expect_hits({.accel = Accel::rayquery});
}
#endif

TEST_F(GpuAssisted, ChecksFindNothingInRaysFromABuffer) {
  std::mt19937_64 random(7);
  const std::vector<CastRay> rays = stress::rays_at_surface(scene_, random, 100);
  const TraceParams params = make_params(scene_, framed_settings(mesh_, scene_, kSide, kSide));
  RayCaster caster(device_, scene_, params, SOLVER_ROBUST);
  EXPECT_EQ(caster.cast(rays).size(), rays.size());
}

}  // namespace
}  // namespace trisect
