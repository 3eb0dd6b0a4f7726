#include "tests/support/gpu.h"

#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "app/bake/subpatch_bounds.h"

namespace trisect::test {
namespace {

// Those on validated_device().
std::shared_ptr<const TracerKernels> shared_kernels(const BakedScene& scene,
                                                    const KernelChoice& choice) {
  const gpu::Device& device = validated_device();
  // Made after the device and destroyed before it.
  static std::vector<std::shared_ptr<const TracerKernels>> made;
  KernelPlan plan = plan_kernels(device, scene, choice, kNoLimit);
  for (const auto& kernels : made) {
    if (kernels->plan() == plan) return kernels;
  }
  made.push_back(std::make_shared<const TracerKernels>(device, std::move(plan), nullptr));
  return made.back();
}

}  // namespace

bool validates() {
  const char* value = std::getenv("TRISECT_TEST_VALIDATION");
  return value == nullptr || std::string_view(value) != "0";
}

const gpu::Instance& validated_instance() {
  static const gpu::Instance instance(validates());
  return instance;
}

const gpu::Device& validated_device() {
  static const gpu::Device device(validated_instance(), "");
  return device;
}

VulkanTracer tracer_of(const BakedScene& scene, uint32_t width, uint32_t height,
                       const KernelChoice& choice, std::size_t buffer_limit,
                       const gpu::Device& device) {
  if (&device == &validated_device() && buffer_limit == kNoLimit) {
    return {device, scene, width, height, choice, shared_kernels(scene, choice)};
  }
  return {device, scene, width, height, choice, buffer_limit};
}

Frame trace(const BakedScene& baked, const TraceSettings& settings) {
  Frame frame;
  BakedScene scene = baked;
  if (settings.solver == SOLVER_ROBUST) scene.subpatches = bake_subpatches(scene);
  VulkanTracer tracer =
      tracer_of(scene, settings.width, settings.height, {settings.solver, true, true});
  tracer.render(make_params(scene, settings), frame);
  return frame;
}

TraceSettings framed(const Mesh& mesh, const BakedScene& scene, uint32_t width, uint32_t height,
                     uint32_t rank) {
  TraceSettings settings = framed_settings(mesh, scene, width, height);
  settings.solver = SOLVER_BISECT;
  settings.rank = rank;
  return settings;
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
    // The counts of work may differ.
    const bool same = p.normal_z == q.normal_z && p.geometric_u == q.geometric_u && p.v == q.v &&
                      p.triangle == q.triangle;
    if (!same) ++different;
  }
  EXPECT_EQ(different, 0U) << what;
}

}  // namespace trisect::test
