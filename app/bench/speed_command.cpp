#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/base/stopwatch.h"
#include "app/bench/commands.h"
#include "app/bench/contender.h"
#include "app/bench/sample_check.h"
#include "app/bench/speed_report.h"
#include "app/cli/cache_folder.h"
#include "app/cli/interrupt.h"
#include "app/cli/json_text.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/progress_line.h"
#include "app/cli/statistics.h"
#include "app/dispatch/pipeline_store.h"
#include "app/dispatch/trace_settings.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"

namespace trisect {
namespace {

using bench::Contender;
using bench::EmbreeRays;
using bench::SampleCheck;

// The oracle checks every 20th pixel of every 20th row.
constexpr uint32_t kCheckStep = 20;

struct Runner {
  std::string name;
  std::unique_ptr<Contender> contender;
  const SampleCheck* check;     // null if its image shows no scene
  std::optional<double> build;  // milliseconds for the structure that its rays traverse
  std::size_t wrong = 0;
  std::vector<double> times;
  std::vector<double> cpu_times;
};

template <typename Make>
auto timed(double& ms, Make&& make) {
  const Stopwatch watch;
  auto made = make();
  ms += watch.milliseconds();
  return made;
}

SampleCheck checked(const std::string& model, const BakedScene& scene, const TraceParams& params) {
  ProgressLine progress(fmt::format("oracle, {}", model),
                        (params.height + kCheckStep - 1) / kCheckStep);
  return {scene, params, kCheckStep, [&](uint32_t rows) { return progress.show(rows); }};
}

// All contenders on one model with one surface.
class Race {
 public:
  Race(const gpu::Device& device, const BenchOptions& options, const std::string& model,
       uint surface)
      : options_(options), mesh_(build_mesh(read_model(model), model).mesh) {
    const SurfaceChoice normal{surface, 0.65, SHELL_NORMAL};
    double bake_ms = 0.0;
    scene_ = timed(bake_ms, [&] { return bake_with_subpatches(mesh_, normal); });
    double bvh_ms = bake_ms;
    scene_.bvh = timed(bvh_ms, [&] { return build_bvh(scene_); });
    double thesis_ms = 0.0;
    thesis_scene_ = timed(thesis_ms, [&] { return bake(mesh_, {surface, 0.65, SHELL_HEIGHT}); });
    params_ = params_of(scene_, SOLVER_ROBUST);
    thesis_params_ = params_of(thesis_scene_, SOLVER_BISECT);
    check_.emplace(checked(model, scene_, params_));
    thesis_check_.emplace(checked(model, thesis_scene_, thesis_params_));

    add("image only", bench::image_only(device, params_), nullptr);
    add("thesis (list, bisect, Rank 10)",
        bench::on_vulkan(bench::kernels_for(device, thesis_scene_,
                                            {.solver = SOLVER_BISECT, .accel = Accel::list}),
                         thesis_params_),
        &*thesis_check_, thesis_ms);
    add_robust(device, "list, robust", Accel::list, bake_ms);
    if (device.subgroup_size() != 0) add_robust(device, "tiles, robust", Accel::tiles, bake_ms);
    add_robust(device, "bvh, robust", Accel::bvh, bvh_ms);
    if (device.has_ray_query()) {
      add_robust(device, "rayquery, robust", Accel::rayquery, bvh_ms);
    }
    add_embree();
  }

  void run() {
    Frame frame;
    for (Runner& row : rows_) {
      row.contender->render(frame);
      if (row.check != nullptr) row.wrong = row.check->count_wrong(frame);
    }
    // In turns, so that other load on the machine affects all contenders alike.
    for (uint32_t run = 0; run < options_.runs; ++run) {
      for (Runner& row : rows_) {
        const bench::Timing time = bench::take_turn(*row.contender, frame);
        row.times.push_back(time.ms);
        row.cpu_times.push_back(time.cpu_ms);
        stop_if_interrupted();
      }
    }
  }

  [[nodiscard]] const std::vector<Runner>& rows() const { return rows_; }
  [[nodiscard]] std::size_t patches() const { return scene_.triangles.size(); }
  [[nodiscard]] std::size_t flat_triangles() const { return flat_triangles_; }
  [[nodiscard]] double flat_error() const { return flat_error_; }

 private:
  [[nodiscard]] TraceParams params_of(const BakedScene& scene, uint solver) const {
    TraceSettings settings = framed_settings(mesh_, scene, options_.width, options_.height);
    settings.solver = solver;
    return make_params(scene, settings);
  }

  void add(const std::string& name, std::unique_ptr<Contender> contender, const SampleCheck* check,
           std::optional<double> build = std::nullopt) {
    rows_.push_back({name, std::move(contender), check, build, 0, {}, {}});
  }

  void add_robust(const gpu::Device& device, const std::string& name, Accel accel, double build) {
    add(name,
        bench::on_vulkan(
            bench::kernels_for(device, scene_, {.solver = SOLVER_ROBUST, .accel = accel}), params_),
        &*check_, build);
  }

  void add_embree() {
    const BusyLine busy("cutting the surface for Embree");
    const uint32_t n = bench::affordable_divisions_for(scene_, options_.error);
    flat_error_ = bench::tessellation_error(scene_, n);
    double cut_ms = 0.0;
    const bench::Tessellation flat = timed(cut_ms, [&] { return bench::tessellate(scene_, n); });
    flat_triangles_ = flat.triangles.size();
    for (const EmbreeRays rays : {EmbreeRays::packets, EmbreeRays::single}) {
      double ms = cut_ms;
      auto embree = timed(ms, [&] { return bench::on_embree(scene_, flat, params_, rays); });
      add(bench::embree_name(rays), std::move(embree), &*check_, ms);
    }
  }

  const BenchOptions& options_;
  Mesh mesh_;
  BakedScene scene_;         // with a tree
  BakedScene thesis_scene_;  // without
  TraceParams params_{};
  TraceParams thesis_params_{};
  std::optional<SampleCheck> check_;
  std::optional<SampleCheck> thesis_check_;
  std::vector<Runner> rows_;
  std::size_t flat_triangles_ = 0;
  double flat_error_ = 0.0;
};

// The measurements of a race that has run.
std::vector<bench::SpeedRow> rows_of(const std::string& model, uint surface, const Race& race) {
  const double floor_ms = spread_of(race.rows()[0].times).median;
  const double thesis_ms = spread_of(race.rows()[1].times).median;
  std::vector<bench::SpeedRow> rows;
  for (const Runner& runner : race.rows()) {
    bench::SpeedRow row;
    row.model = model;
    row.surface = surface;
    row.patches = race.patches();
    row.contender = runner.name;
    row.ms = spread_of(runner.times);
    row.cpu_ms = spread_of(runner.cpu_times);
    row.thesis_ms = thesis_ms;
    row.floor_ms = floor_ms;
    if (runner.check != nullptr) {
      row.checked_pixels = runner.check->pixels();
      row.wrong_pixels = runner.wrong;
    }
    row.bytes = runner.contender->bytes();
    row.build_ms = runner.build;
    if (runner.name.starts_with("Embree")) {
      row.flat_triangles = race.flat_triangles();
      row.flat_error = race.flat_error();
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

int bench_speed(const BenchOptions& options) {
  begin_outputs(options.models, {options.json});
  const gpu::Instance instance(false);
  const gpu::Device device(instance, options.device);
  const PipelineStore store(device, cache_folder());
  OptionalOutput file(options.json);
  expect_readable(options.models);
  say("device {}, driver {}, {}x{}, medians of {} runs\n\n{}", device.report().name,
      device.report().driver, options.width, options.height, options.runs,
      bench::speed_columns().markdown_header());
  nlohmann::ordered_json json;
  json["device"] = device.report().name;
  json["driver"] = device.report().driver;
  json["width"] = options.width;
  json["height"] = options.height;
  json["runs"] = options.runs;
  json["rows"] = nlohmann::ordered_json::array();
  for (const std::string& model : options.models) {
    for (const uint surface : options.surfaces) {
      Race race(device, options, model, surface);
      race.run();
      for (const bench::SpeedRow& row : rows_of(model, surface, race)) {
        say("{}", bench::speed_columns().markdown_row(row));
        json["rows"].push_back(bench::speed_columns().json(row));
      }
    }
  }
  file.write(json_text(json));
  file.commit();
  return exit_done;
}

}  // namespace trisect
