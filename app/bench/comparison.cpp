#include "app/bench/comparison.h"

#include <fmt/format.h>

#include <utility>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/bench/pareto_front.h"
#include "app/cli/interrupt.h"
#include "app/cli/progress_line.h"
#include "app/dispatch/trace_settings.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/mesh/obj_file.h"
#include "app/oracle/oracle_tracer.h"

namespace trisect::bench {

TraceParams params_of(const Mesh& mesh, const BakedScene& scene, const ImageSize& size, uint solver,
                      uint32_t rank) {
  TraceSettings settings = framed_settings(mesh, scene, size.width, size.height);
  settings.solver = solver;
  settings.rank = rank;
  return make_params(scene, settings);
}

namespace {

View view_of(const std::string& model, const Mesh& mesh, const ImageSize& size,
             const SurfaceChoice& choice) {
  View view;
  view.scene = bake_with_subpatches(mesh, choice);
  view.params = params_of(mesh, view.scene, size, SOLVER_ROBUST, 10);
  ProgressLine progress(fmt::format("oracle, {}", model), size.height);
  view.truth = finished(
      trace_with_oracle(view.scene, view.params, [&](uint32_t y) { return progress.show(y); }));
  view.shown = frame_of(view.truth, view.scene, view.params);
  return view;
}

}  // namespace

Subject::Subject(const std::string& file, uint surface_choice, const ImageSize& image_size)
    : model(model_name(file)),
      surface(surface_choice),
      size(image_size),
      mesh(build_mesh(read_model(file), file).mesh),
      height(view_of(model, mesh, size, {surface, 0.65, SHELL_HEIGHT})),
      normal(view_of(model, mesh, size, {surface, 0.65, SHELL_NORMAL})) {
  normal.scene.bvh = build_bvh(normal.scene);
}

std::size_t wrong_pixels(const Measurement& one) {
  return one.errors.wrong + one.errors.missed;
}

void Comparison::add(const std::string& family, const std::string& number, const View& view,
                     std::unique_ptr<Contender> contender) {
  Measurement measurement;
  measurement.family = family;
  measurement.number = number;
  entries_.push_back({std::move(measurement), &view, std::move(contender), {}});
}

void Comparison::inspect(const std::string& family, const std::string& number, Frame& frame) {
  for (Entry& entry : entries_) {
    if (entry.measurement.family == family && entry.measurement.number == number) {
      entry.contender->inspect(frame);
    }
  }
}

std::vector<Measurement> Comparison::measure(const std::string& model, uint32_t runs) {
  ProgressLine progress(fmt::format("measuring {}", model), entries_.size() * (runs + 2));
  uint32_t done = 0;
  Frame frame;
  for (Entry& entry : entries_) {
    entry.contender->inspect(frame);
    Measurement& measurement = entry.measurement;
    measurement.errors = errors_of(frame, entry.view->truth, entry.view->shown, entry.view->scene,
                                   entry.view->params);
    measurement.work = work_of(frame);
    entry.contender->render(frame);
    measurement.bytes = entry.contender->bytes();
    progress.show(done += 2);
  }
  for (uint32_t run = 0; run < runs; ++run) {
    for (Entry& entry : entries_) {
      entry.times.push_back(take_turn(*entry.contender, frame).ms);
      stop_if_interrupted();
      progress.show(++done);
    }
  }
  std::vector<Measurement> measurements;
  std::vector<Point> points;
  for (Entry& entry : entries_) {
    entry.measurement.ms = spread_of(entry.times);
    points.push_back({entry.measurement.errors.rms, entry.measurement.ms.median});
    measurements.push_back(entry.measurement);
  }
  const std::vector<std::optional<std::size_t>> by = dominating(points);
  for (std::size_t i = 0; i < by.size(); ++i) measurements[i].dominated_by = by[i];
  return measurements;
}

}  // namespace trisect::bench
