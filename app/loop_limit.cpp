#include "app/loop_limit.h"

#include <fmt/format.h>

#include <string>

#include "app/cage.h"
#include "vk/result.h"

namespace trisect {

void expect_loops_to_end(const gpu::Device& device, const BakedScene& scene, uint solver) {
  if (device.report().name.find("llvmpipe") == std::string::npos) return;
  constexpr std::size_t iterations = 60000;  // the rest is for the search of a patch
  // Measured: the robust solver's inner loops count once for a cage that is passed by. Parts that
  // are skipped in groups count for nothing; that most are is what the looser limit there stands
  // on.
  const bool robust = solver == SOLVER_ROBUST;
  const std::size_t items = robust ? scene.cages.size() : scene.triangles.size();
  const std::size_t each = robust && !has_groups(scene) ? 5 : 1;
  if (items * each <= iterations) return;
  throw gpu::Error(fmt::format(
      "device {} ends loops after 65535 iterations, which is too few for the {} patches of this "
      "model; --backend cpu has no such limit.",
      device.report().name, scene.triangles.size()));
}

}  // namespace trisect
