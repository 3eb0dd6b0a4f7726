#include "app/cli/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/base/stopwatch.h"
#include "app/cli/camera_path.h"
#include "app/cli/interrupt.h"
#include "app/cli/model_sha256.h"
#include "app/cli/named.h"
#include "app/cli/output.h"
#include "app/cli/progress_line.h"
#include "app/frame/supersampling.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "vk/instance.h"

namespace trisect {
namespace {

// Runs a step, sets `ms` to the milliseconds that it took, and shows its name meanwhile.
template <typename Step>
auto timed(const std::string& name, double& ms, Step&& step) {
  const Stopwatch watch;
  const BusyLine line(name);
  auto result = step();
  ms = watch.milliseconds();
  stop_if_interrupted();
  return result;
}

}  // namespace

AccelRequest accel_request(const RenderOptions& options, bool subgroups) {
  const uint32_t side = samples_across(options.spp);
  // The whole image's size, for parts too: they are made in the same way.
  return {options.accel,        options.solver,        options.shadows,
          options.width * side, options.height * side, subgroups};
}

Accel accel_for(const RenderOptions& options, Backend backend, const BakedScene& scene) {
  const std::size_t subpatches = scene.subpatches.size();
  const Accel accel = chosen_accel(accel_request(options, true), backend, subpatches);
  if (options.accel || accel != Accel::tiles) {
    detail("accel {}, {}\n", accel_name(accel),
           options.accel ? "as asked for"
                         : "as the model's size, the image's and the back end have it");
    return accel;
  }
  const gpu::Instance instance(false);
  const std::size_t index = gpu::choose_device(instance.reports(), options.device);
  const uint32_t lanes = instance.devices()[index].subgroups.size;
  const Accel chosen = chosen_accel(accel_request(options, lanes != 0), backend, subpatches);
  detail("accel {}, with subgroups of {} on the device\n", accel_name(chosen), lanes);
  return chosen;
}

TraceSettings settings_of(const RenderOptions& options, const Mesh& mesh, const BakedScene& scene) {
  TraceSettings settings;
  const uint32_t side = samples_across(options.spp);
  if (std::max(options.width, options.height) > kLargestSide / side) {
    throw UsageError(fmt::format("--spp {}: an image of {}x{} has more than {} rays a side.",
                                 options.spp, options.width, options.height, kLargestSide));
  }
  settings.width = options.width * side;
  settings.height = options.height * side;
  if (options.tile) {
    const ImagePart& tile = *options.tile;
    settings.part = {tile.x * side, tile.y * side, tile.width * side, tile.height * side};
  }
  settings.solver = options.solver;
  settings.rank = options.rank;
  const double aspect = static_cast<double>(options.width) / static_cast<double>(options.height);
  settings.camera = framing_camera(mesh.positions, scene.origin, options.fov, options.up, aspect);
  if (options.turntable) {
    settings.camera = CameraPath::framing(settings.camera, mesh.positions, aspect);
  }
  if (options.eye) settings.camera.eye = *options.eye;
  if (options.target) settings.camera.target = *options.target;
  if (options.light) settings.light = *options.light;
  settings.shading = options.shading.value_or(SHADING_PLAIN);
  settings.own_colors = !options.color;
  settings.color = options.color.value_or(standard_color(settings.shading));
  settings.background =
      options.background.value_or(is_lit(settings.shading) ? Background::sky : Background::color);
  settings.background_color = options.background_color;
  return settings;
}

LoadedScene load_scene(const RenderOptions& options) {
  LoadedScene loaded{};
  std::vector<std::filesystem::path> files;
  const BuiltMesh built = timed("reading " + options.model, loaded.load_ms, [&] {
    PolygonModel model = read_model(options.model);
    files = model.files;
    return build_mesh(std::move(model), options.model, options.mesh);
  });
  // Not in the time that reading takes.
  loaded.model_sha256 = model_sha256(options.model, files);
  detail("read in {:.1f} ms, SHA-256 {}\n", loaded.load_ms, loaded.model_sha256);
  say("{}: {}\n", options.model, describe(built.report));
  const SurfaceChoice choice{options.surface, options.alpha, options.shell};
  const Stopwatch watch;
  loaded.scene = named(options.model, [&] {
    return options.solver == SOLVER_ROBUST ? bake_showing_progress(built.mesh, choice)
                                           : bake(built.mesh, choice);
  });
  loaded.bake_ms = watch.milliseconds();
  detail("baked in {:.1f} ms: {} patches, {} subpatches, {} bytes on a device\n", loaded.bake_ms,
         loaded.scene.triangles.size(), loaded.scene.subpatches.size(), device_bytes(loaded.scene));
  if (const std::size_t count = count_without_surface(loaded.scene); count > 0) {
    say("{}: no surface in the height shell for {} of the triangles, which have a vertex normal in "
        "their plane\n",
        options.model, count);
  }
  loaded.settings = settings_of(options, built.mesh, loaded.scene);
  loaded.params = make_params(loaded.scene, loaded.settings);
  return loaded;
}

BakedScene bake_showing_progress(const Mesh& mesh, const SurfaceChoice& choice) {
  ProgressLine line("baking", mesh.triangles.size());
  return finished(
      bake_with_subpatches(mesh, choice, [&](uint32_t done) { return line.show(done); }));
}

void expect_readable(const std::vector<std::string>& models) {
  for (const std::string& model : models) {
    const Mesh mesh = build_mesh(read_model(model), model).mesh;
    named(model, [&] { expect_size(mesh); });
    stop_if_interrupted();
  }
}

TraceResult trace_showing_progress(const TraceRequest& request, const BakedScene& scene,
                                   const TraceParams& params, const KernelChoice& choice) {
  ProgressLine line("rendering");
  return finished(
      trace_scene(request, scene, params, choice, [&](double done) { return line.show(done); }));
}

void add_bvh(LoadedScene& loaded) {
  double ms = 0.0;
  loaded.scene.bvh = timed("building the tree", ms, [&] { return build_bvh(loaded.scene); });
  loaded.bvh_ms = ms;
  detail("made a tree of {} nodes in {:.1f} ms\n", loaded.scene.bvh.size(), ms);
}

}  // namespace trisect
