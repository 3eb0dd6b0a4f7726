#include "app/bench/pareto.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/bake/subpatch_bounds.h"
#include "app/bench/comparison.h"
#include "app/cli/progress_line.h"

namespace trisect::bench {

Scene measure_scene(const gpu::Device& device, const ParetoOptions& options,
                    const std::string& model, uint surface) {
  const Subject subject(model, surface, {options.width, options.height});
  const View& height = subject.height;
  const View& normal = subject.normal;
  Scene result;
  result.model = subject.model;
  result.surface = surface;
  result.patches = subject.mesh.triangles.size();
  const BakedScene flat = bake_with_subpatches(subject.mesh, {SURFACE_FLAT, 0.65, SHELL_NORMAL});

  Comparison comparison;
  for (const auto& [family, view] :
       {std::pair{kThesisHeight, &height}, std::pair{"thesis, normal shell", &normal}}) {
    const auto kernels =
        kernels_for(device, view->scene, {.solver = SOLVER_BISECT, .accel = Accel::list});
    for (const uint32_t rank : options.ranks) {
      comparison.add(family, fmt::format("Rank {}", rank), *view,
                     on_vulkan(kernels, params_of(subject.mesh, view->scene, subject.size,
                                                  SOLVER_BISECT, rank)));
    }
  }
  for (const auto& [family, accel] :
       {std::pair{kRobustTiles, Accel::tiles}, std::pair{"robust, bvh", Accel::bvh},
        std::pair{"robust, list", Accel::list}}) {
    comparison.add(
        family, "", normal,
        on_vulkan(kernels_for(device, normal.scene, {.solver = SOLVER_ROBUST, .accel = accel}),
                  normal.params));
  }
  const TraceParams flat_params = params_of(subject.mesh, flat, subject.size, SOLVER_ROBUST, 10);
  comparison.add(
      "flat triangles, tiles", "", normal,
      on_vulkan(kernels_for(device, flat, {.solver = SOLVER_ROBUST, .accel = Accel::tiles}),
                flat_params));
  std::vector<uint32_t> divisions = options.divisions;
  if (options.finest_error > 0.0) {
    const BusyLine busy("cutting the surface for Embree");
    divisions.push_back(affordable_divisions_for(normal.scene, options.finest_error));
  }
  for (const uint32_t n : divisions) {
    const Tessellation cut = tessellate(normal.scene, n);
    for (const EmbreeRays rays : {EmbreeRays::packets, EmbreeRays::single}) {
      comparison.add(embree_name(rays), fmt::format("n = {}", n), normal,
                     on_embree(normal.scene, cut, normal.params, rays));
    }
    // OpenGL guarantees tessellation levels up to 64.
    if (n > 64 || !options.opengl) continue;
    comparison.add(kRasterizer, fmt::format("level {}", n), normal,
                   on_opengl(normal.scene, normal.params, n));
  }
  result.measurements = comparison.measure(result.model, options.runs);
  result.truth = height.shown;
  comparison.inspect(kThesisHeight, "Rank 10", result.thesis);
  return result;
}

}  // namespace trisect::bench
