#include "app/bench/shape.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/bench/contender.h"
#include "app/bench/decimated.h"
#include "app/bench/image_errors.h"
#include "app/bench/model_steps.h"
#include "app/bench/tessellation.h"
#include "app/cli/interrupt.h"
#include "app/cli/named.h"
#include "app/cli/progress_line.h"
#include "app/crosscheck/frame_comparison.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/trace_settings.h"
#include "app/mesh/bounds.h"
#include "app/mesh/obj_file.h"
#include "app/tessellation/flat_mesh.h"

namespace trisect::bench {
namespace {

constexpr std::size_t kSamples = 100'000;

// Distances below this part of the radius count as none.
constexpr double kResolution = 1e-7;

constexpr SurfaceChoice kFlat{SURFACE_FLAT, 0.65, SHELL_NORMAL};

std::vector<SurfaceChoice> choices() {
  return {kFlat,
          {SURFACE_PHONG, 0.5, SHELL_NORMAL},
          {SURFACE_PHONG, 0.65, SHELL_NORMAL},
          {SURFACE_PHONG, 0.75, SHELL_NORMAL},
          {SURFACE_SPHERE, 0.65, SHELL_NORMAL}};
}

// The surface as triangles, for distances: flat ones as they are. Where `error` takes more
// triangles than there may be, so that they are off the surface by ten times that, or a hundred.
FlatMesh triangles_of(const std::string& model, const Mesh& mesh, const BakedScene& scene,
                      double error) {
  ProgressLine line("dividing " + model);
  const FractionProgress show = [&](double done) { return line.show(done); };
  if (scene.choice.surface == SURFACE_FLAT) {
    return finished(divided_evenly(mesh, scene, 1, show));
  }
  for (const double allowed : {error, 10.0 * error}) {
    try {
      return finished(divided_to(mesh, scene, allowed, show));
    } catch (const InputError&) {
      stop_if_interrupted();
    }
  }
  return named(model, [&] { return finished(divided_to(mesh, scene, 100.0 * error, show)); });
}

// Distances between models that are apart say nothing about their shape.
void expect_to_meet(const std::string& model, const Mesh& mesh, const std::string& reference,
                    const Mesh& fine) {
  const Bounds box = bounds_of(mesh.positions);
  const Bounds fine_box = bounds_of(fine.positions);
  if (glm::all(glm::lessThanEqual(box.low, fine_box.high)) &&
      glm::all(glm::lessThanEqual(fine_box.low, box.high))) {
    return;
  }
  throw InputError(
      fmt::format("{}: is not where {} is: their bounding boxes do not meet.", model, reference));
}

// Bounded for the surfaces themselves, which can be farther off than their triangles.
LargestDistance largest(const std::string& model, const FlatMesh& from, const Target& to,
                        double radius) {
  ProgressLine line("measuring " + model);
  LargestDistance found = finished(largest_distance(from, to, kResolution * radius,
                                                    [&](double done) { return line.show(done); }));
  found.found /= radius;
  found.bound = (found.bound + from.bound + to.mesh().bound) / radius;
  return found;
}

Samples samples_of(const std::string& model, const FlatMesh& from, const Target& to,
                   double radius) {
  ProgressLine line("measuring " + model);
  Samples samples =
      finished(sampled(from, to, kSamples, [&](double done) { return line.show(done); }));
  for (double* length :
       {&samples.distance.p50, &samples.distance.p99, &samples.distance.max, &samples.rms}) {
    *length /= radius;
  }
  return samples;
}

// A scene that is drawn with a camera.
struct Drawn {
  BakedScene scene;
  TraceParams params{};
  Accel accel = Accel::list;
  std::unique_ptr<Contender> contender;
  std::vector<double> times;
};

std::unique_ptr<Contender> contender_for(const gpu::Device& device, const Drawn& drawn) {
  return on_vulkan(
      kernels_for(device, drawn.scene, {.solver = SOLVER_ROBUST, .accel = drawn.accel}),
      drawn.params);
}

// With AOVs. The buffers for them are given back.
Frame frame_of(const gpu::Device& device, const Drawn& drawn) {
  Frame frame;
  contender_for(device, drawn)->inspect(frame);
  return frame;
}

std::unique_ptr<Drawn> drawn(const gpu::Device& device, const ShapeOptions& options,
                             BakedScene scene, const TraceSettings& settings) {
  auto result = std::make_unique<Drawn>();
  result->scene = std::move(scene);
  const AccelRequest request{
      .width = options.width, .height = options.height, .subgroups = device.subgroup_size() != 0};
  result->accel = chosen_accel(request, Backend::vulkan, result->scene.subpatches.size());
  if (needs_bvh(result->accel, false)) add_tree(result->scene);
  result->params = make_params(result->scene, settings);
  result->contender = contender_for(device, *result);
  return result;
}

void compare_pictures(const Frame& frame, const Frame& shown, ShapeRow& row) {
  const FrameComparison comparison = compare(frame, shown);
  row.wrong = comparison.hit_mismatches;
  row.color_rmse = comparison.color_rmse;
  row.outline = outline_errors(frame, shown);
  row.similarity = structural_similarity(frame, shown);
  row.relative = relative_square_error(frame, shown);
}

}  // namespace

Shape measure_shape(const gpu::Device& device, const ShapeOptions& options) {
  Shape shape;
  shape.reference = model_name(options.reference);
  const Mesh mesh = read_mesh(options.reference);
  BakedScene scene = baked(options.reference, mesh, kFlat);
  shape.triangles = mesh.triangles.size();
  shape.radius = scene.extent;
  const FlatMesh flat = triangles_of(options.reference, mesh, scene, 0.0);
  const Target target(flat);
  const TraceSettings settings = framed_settings(mesh, scene, options.width, options.height);
  const std::unique_ptr<Drawn> truth = drawn(device, options, std::move(scene), settings);
  const Frame shown = frame_of(device, *truth);
  const std::unique_ptr<Contender> embree =
      on_embree(truth->scene, tessellate(truth->scene, 1), truth->params, EmbreeRays::packets);
  std::vector<double> embree_times;

  std::vector<std::unique_ptr<Drawn>> models;
  const auto measure = [&](const std::string& name, const Mesh& coarse) {
    for (const SurfaceChoice& choice : choices()) {
      ShapeRow row;
      row.model = name;
      row.triangles = coarse.triangles.size();
      row.choice = choice;
      BakedScene coarse_scene = baked(name, coarse, choice);
      const FlatMesh surface =
          triangles_of(name, coarse, coarse_scene, options.error * shape.radius);
      row.off_surface = surface.bound / shape.radius;
      row.samples = samples_of(name, surface, target, shape.radius);
      row.to_shape = largest(name, surface, target, shape.radius);
      row.to_model = largest(name, flat, Target(surface), shape.radius);
      models.push_back(drawn(device, options, std::move(coarse_scene), settings));
      row.accel = models.back()->accel;
      compare_pictures(frame_of(device, *models.back()), shown, row);
      shape.rows.push_back(std::move(row));
    }
  };
  for (const std::string& file : options.models) {
    const Mesh coarse = read_mesh(file);
    expect_to_meet(file, coarse, options.reference, mesh);
    measure(model_name(file), coarse);
  }
  for (const uint32_t count : options.decimate) {
    const Mesh coarse = [&] {
      const BusyLine line("decimating " + options.reference);
      return decimated(flat, count, options.reference);
    }();
    measure(fmt::format("{}-{}", shape.reference, coarse.triangles.size()), coarse);
  }
  ProgressLine line("timing frames", options.runs);
  Frame frame;
  for (const auto& model : models) model->contender->render(frame);
  truth->contender->render(frame);
  embree->render(frame);
  for (uint32_t run = 0; run < options.runs; ++run) {
    for (const auto& model : models) {
      model->times.push_back(take_turn(*model->contender, frame).ms);
      stop_if_interrupted();
    }
    truth->times.push_back(take_turn(*truth->contender, frame).ms);
    embree_times.push_back(take_turn(*embree, frame).ms);
    line.show(run + 1);
  }
  for (std::size_t i = 0; i < models.size(); ++i) {
    shape.rows[i].ms = spread_of(models[i]->times);
    shape.rows[i].bytes = models[i]->contender->bytes();
  }
  shape.frames = {{"trisect", spread_of(truth->times), truth->contender->bytes()},
                  {embree_name(EmbreeRays::packets), spread_of(embree_times), embree->bytes()}};
  return shape;
}

}  // namespace trisect::bench
