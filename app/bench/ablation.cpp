#include "app/bench/ablation.h"

#include <memory>
#include <utility>

namespace trisect::bench {

Ablation measure_ablation(const gpu::Device& device, const AblationOptions& options,
                          const std::string& model, uint surface) {
  const Subject subject(model, surface, {options.width, options.height});
  const View& height = subject.height;
  const View& normal = subject.normal;
  Ablation result;
  result.model = subject.model;
  result.surface = surface;
  result.patches = subject.mesh.triangles.size();
  result.pixels = std::size_t{options.width} * options.height;

  Comparison comparison;
  // Returns the step's index.
  const auto add = [&](const char* change, std::size_t from, const View& view,
                       const BakedScene& scene, const KernelChoice& choice, uint32_t rank) {
    comparison.add(change, "", view,
                   on_vulkan(kernels_for(device, scene, choice),
                             params_of(subject.mesh, scene, subject.size, choice.solver, rank)));
    result.steps.push_back({change, from, {}});
    return result.steps.size() - 1;
  };
  const KernelChoice bisection{.solver = SOLVER_BISECT};
  const std::size_t thesis = add("the thesis: bisection at Rank 10, height shell, list", 0, height,
                                 height.scene, bisection, 10);
  const std::size_t rank = add("Rank 20", thesis, height, height.scene, bisection, 20);
  const std::size_t shell = add("the normal shell", rank, normal, normal.scene, bisection, 20);
  const std::size_t solver = add("the robust solver", shell, normal, normal.scene, {}, 10);
  const std::size_t lists = add("lists of tiles, by bounding balls", solver, normal, normal.scene,
                                {.accel = Accel::tiles, .balls = true}, 10);
  const std::size_t hulls =
      add("bounds of the control points", lists, normal, normal.scene, {.accel = Accel::tiles}, 10);
  add("the tree instead of tiles", hulls, normal, normal.scene, {.accel = Accel::bvh}, 10);
  add("the height shell again", hulls, height, height.scene, {.accel = Accel::tiles}, 10);
  std::vector<Measurement> measured = comparison.measure(result.model, options.runs);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    result.steps[i].measurement = std::move(measured[i]);
  }
  return result;
}

}  // namespace trisect::bench
