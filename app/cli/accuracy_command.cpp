#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/accuracy/accuracy.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/cli/accuracy_report.h"
#include "app/cli/cache_folder.h"
#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/json_text.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/progress_line.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/pipeline_store.h"
#include "app/dispatch/trace_settings.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/oracle/oracle_tracer.h"

namespace trisect {
namespace {

// What the robust solver promises, in both shells: no wrong answer where the oracle is sure, few
// where it is not, and errors of a few roundings.
constexpr double kMostUndecidable = 2e-4;  // of the pixels
constexpr double kOffSurfaceP99 = 2.5e-7;
constexpr double kOffSurfaceMax = 2e-6;
constexpr double kNormalDegreesP99 = 0.05;

bool keeps_promise(const Accuracy& a) {
  return a.wrong_hits == 0 && a.missed == 0 && a.wrong_patches == 0 && a.nans == 0 &&
         static_cast<double>(a.undecidable) <= kMostUndecidable * static_cast<double>(a.pixels) &&
         a.off_surface.p99 <= kOffSurfaceP99 && a.off_surface.max <= kOffSurfaceMax &&
         a.normal_degrees.p99 <= kNormalDegreesP99;
}

std::size_t count_differences(const Frame& a, const Frame& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.aovs.size(); ++i) {
    const PixelAovs& p = a.aovs[i];
    const PixelAovs& q = b.aovs[i];
    const bool same = p.triangle == q.triangle && p.normal_z.w == q.normal_z.w &&
                      p.geometric_u.w == q.geometric_u.w && p.v == q.v;
    if (!same) ++count;
  }
  return count;
}

AccuracyRow measure(const gpu::Device& device, const BakedScene& scene,
                    const TraceSettings& settings, const OracleFrame& truth) {
  AccuracyRow row;
  row.choice = scene.choice;
  row.solver = settings.solver;
  const TraceParams params = make_params(scene, settings);
  const KernelChoice choice{settings.solver, true, true};
  VulkanTracer tracer(device, scene, settings.width, settings.height, choice);
  Frame frame;
  finished(tracer.render(params, frame, until_interrupted()));  // the warm-up
  row.gpu_ms = finished(tracer.render(params, frame, until_interrupted())).gpu_ms;
  row.accuracy = accuracy_of(frame, truth, scene, params);
  Frame on_cpu;
  trace_on_cpu(scene, params, choice, on_cpu, [](uint32_t) { return not_interrupted(); });
  stop_if_interrupted();
  row.cpu_differs = count_differences(frame, on_cpu);
  return row;
}

std::string verdict(const AccuracyRow& row) {
  if (row.solver == SOLVER_BISECT) return "";
  return keeps_promise(row.accuracy) ? "pass" : "FAIL";
}

std::vector<AccuracyRow> measure_model(const gpu::Device& device, const AccuracyOptions& options,
                                       const std::string& model) {
  const Mesh mesh = build_mesh(read_model(model), model).mesh;
  std::vector<AccuracyRow> rows;
  for (const uint surface : options.surfaces) {
    for (const uint shell : options.shells) {
      const BakedScene scene = bake_showing_progress(mesh, {surface, options.alpha, shell});
      TraceSettings settings = framed_settings(mesh, scene, options.width, options.height);
      ProgressLine progress(fmt::format("oracle, {}", model), options.height);
      const OracleFrame truth = finished(trace_with_oracle(
          scene, make_params(scene, settings), [&](uint32_t y) { return progress.show(y); }));
      for (const uint solver : {SOLVER_ROBUST, SOLVER_BISECT}) {
        settings.solver = solver;
        rows.push_back(measure(device, scene, settings, truth));
        rows.back().model = model;
        rows.back().verdict = verdict(rows.back());
      }
    }
  }
  return rows;
}

}  // namespace

int accuracy(const AccuracyOptions& options) {
  begin_outputs(options.models, {options.json});
  const gpu::Instance instance(false);
  const gpu::Device device(instance, options.device);
  const PipelineStore store(device, cache_folder());
  OptionalOutput file(options.json);
  expect_readable(options.models);
  say("device {}, driver {}, {}x{}\n\n{}", device.report().name, device.report().driver,
      options.width, options.height, accuracy_table_header());
  nlohmann::ordered_json json;
  json["device"] = device.report().name;
  json["driver"] = device.report().driver;
  json["width"] = options.width;
  json["height"] = options.height;
  json["rows"] = nlohmann::ordered_json::array();
  bool kept = true;
  for (const std::string& model : options.models) {
    for (const AccuracyRow& row : measure_model(device, options, model)) {
      say("{}", accuracy_columns().markdown_row(row));
      json["rows"].push_back(accuracy_columns().json(row));
      kept = kept && (row.solver == SOLVER_BISECT || keeps_promise(row.accuracy));
    }
  }
  file.write(json_text(json));
  file.commit();
  return kept ? exit_done : exit_different;
}

}  // namespace trisect
