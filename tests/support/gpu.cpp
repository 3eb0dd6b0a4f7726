#include "tests/support/gpu.h"

#include <cstdlib>
#include <string_view>

#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/vulkan_tracer.h"

namespace trisect::test {

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

Frame trace(const BakedScene& baked, const TraceSettings& settings) {
  Frame frame;
  BakedScene scene = baked;
  if (settings.solver == SOLVER_ROBUST) scene.subpatches = bake_subpatches(scene);
  VulkanTracer tracer(validated_device(), scene, settings.width, settings.height,
                      {settings.solver, true, true});
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

}  // namespace trisect::test
