#include "app/load_scene.h"

#include <fmt/format.h>

#include "app/bvh.h"
#include "app/cage.h"
#include "app/interrupt.h"
#include "app/mesh_builder.h"
#include "app/stopwatch.h"

namespace trisect {
namespace {

// Runs a step and tells its milliseconds.
template <typename Step>
auto timed(double& ms, Step&& step) {
  const Stopwatch watch;
  auto result = step();
  ms = watch.milliseconds();
  stop_if_interrupted();
  return result;
}

TraceSettings settings_for(const RenderOptions& options, const Mesh& mesh,
                           const BakedScene& scene) {
  TraceSettings settings;
  settings.width = options.width;
  settings.height = options.height;
  settings.solver = options.solver;
  settings.rank = options.rank;
  const double aspect = static_cast<double>(options.width) / static_cast<double>(options.height);
  settings.camera = framing_camera(mesh.positions, scene.origin, options.fov, options.up, aspect);
  if (options.eye) settings.camera.eye = *options.eye;
  if (options.target) settings.camera.target = *options.target;
  return settings;
}

}  // namespace

LoadedScene load_scene(const RenderOptions& options) {
  LoadedScene loaded{};
  const BuiltMesh built = timed(loaded.load_ms, [&] {
    return build_mesh(read_obj(options.model), options.model, options.crease);
  });
  fmt::print("{}: {}\n", options.model, describe(built.report));
  loaded.scene = timed(loaded.bake_ms, [&] {
    const SurfaceChoice choice{options.surface, options.alpha, options.shell};
    return options.solver == SOLVER_ROBUST ? bake_with_cages(built.mesh, choice)
                                           : bake(built.mesh, choice);
  });
  loaded.params = make_params(loaded.scene, settings_for(options, built.mesh, loaded.scene));
  return loaded;
}

void add_bvh(LoadedScene& loaded) {
  double ms = 0.0;
  loaded.scene.bvh = timed(ms, [&] { return build_bvh(loaded.scene); });
  loaded.bvh_ms = ms;
}

}  // namespace trisect
