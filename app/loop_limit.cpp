#include "app/loop_limit.h"

#include <fmt/format.h>

#include <string>

#include "vk/result.h"

namespace trisect {

void expect_loops_to_end(const gpu::Device& device, const BakedScene& scene, uint solver) {
  if (device.report().name.find("llvmpipe") == std::string::npos) return;
  constexpr std::size_t most = 50000;  // the rest is for the search of patches
  const std::size_t items = solver == SOLVER_ROBUST ? scene.cages.size() : scene.triangles.size();
  if (items <= most) return;
  throw gpu::Error(fmt::format(
      "device {} ends loops after 65535 iterations, which is too few for the {} patches of this "
      "model; --backend cpu has no such limit.",
      device.report().name, scene.triangles.size()));
}

}  // namespace trisect
