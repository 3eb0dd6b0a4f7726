#include "app/bench/command_line.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/base/error.h"
#include "app/bench/commands.h"
#include "app/cli/command_options.h"
#include "app/cli/option_groups.h"
#include "app/cli/options.h"
#include "app/cli/suggestions.h"
#include "app/tessellation/flat_mesh.h"

namespace trisect::bench {
namespace {

CLI::App& subcommand(CLI::App& bench, const std::string& name, const std::string& what) {
  CLI::App* command = bench.add_subcommand(name, what);
  // The last of a repeated option counts.
  command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  return *command;
}

void add_report_folder(CLI::App& command, std::string& output) {
  command.add_option("-o,--output", output, "Folder to write the report into")
      ->group(option_group::kOutput)
      ->required()
      ->check(not_empty())
      ->check(suggest_folders())
      ->type_name("DIR");
}

void add_plots(CLI::App& command, bool& plots) {
  command.add_flag("--no-plots{false}", plots, "Draw no plots: gnuplot is not needed")
      ->group(option_group::kOutput);
}

}  // namespace

CommandLine::CommandLine(CLI::App& app)
    : bench_(*app.add_subcommand(
          "bench", "Measure speed and errors of this program's ways to draw and of others")) {
  bench_.require_subcommand(1);
  add_speed();
  add_pareto();
  add_ablation();
  add_shape();
  add_stability();
  add_terminator();
}

void CommandLine::add_frames(CLI::App& command, const MeasuredModels& defaults) {
  add_size(command, text_.size, fmt::format("{}x{}", defaults.width, defaults.height));
  add_surfaces(command, text_.surface);
  add_runs(command, defaults.runs);
}

void CommandLine::add_runs(CLI::App& command, uint32_t standard) {
  command
      .add_option("--runs", text_.runs,
                  fmt::format("Frames to time after a warm-up, default {}", standard))
      ->group(option_group::kMeasuring)
      ->check(number_from_to(1, 1000))
      ->type_name("N");
}

void CommandLine::add_speed() {
  CLI::App& command = subcommand(
      bench_, "speed",
      "Time the thesis's way, this program's and Embree's on flat triangles, beside each other");
  add_models(command, speed_.models);
  add_frames(command, speed_);
  command
      .add_option("--error", speed_.error,
                  "How far Embree's flat triangles may be off the surface, over the model's "
                  "radius, default 1e-6")
      ->group(option_group::kMeasuring)
      ->check(number_from_to(1e-9, 1.0))
      ->type_name("E");
  add_device(command, speed_.device);
  add_table_json(command, speed_.json);
}

void CommandLine::add_pareto() {
  CLI::App& command = subcommand(
      bench_, "pareto",
      "Measure time against error of every way to draw the models, and write a report with plots");
  add_models(command, pareto_.models);
  add_report_folder(command, pareto_.output);
  add_frames(command, pareto_);
  command
      .add_flag("--quick", quick_,
                "A few contenders, 160x120 pixels, two frames: to see that it works")
      ->group(option_group::kMeasuring);
  command
      .add_option("--hardcases", pareto_.hardcases,
                  "Show the table of this file, which trisect hardcases --json wrote")
      ->group(option_group::kMeasuring)
      ->check(not_empty())
      ->check(suggest_files({".json"}))
      ->type_name("FILE");
  add_plots(command, pareto_.plots);
  command
      .add_flag("--no-opengl{false}", pareto_.opengl,
                "Leave out OpenGL's tessellation shaders: no OpenGL is needed")
      ->group(option_group::kMeasuring);
  add_device(command, pareto_.device);
}

void CommandLine::add_ablation() {
  CLI::App& command = subcommand(
      bench_, "ablation",
      "Measure what each step from the thesis's way to this program's is worth, one change at a "
      "time, and write a report with plots");
  add_models(command, ablation_.models);
  add_report_folder(command, ablation_.output);
  add_frames(command, ablation_);
  add_device(command, ablation_.device);
}

void CommandLine::add_shape() {
  CLI::App& command = subcommand(
      bench_, "shape",
      "Measure how near models come to a shape, by flat and by curved triangles, and write a "
      "report with plots");
  add_models(command, shape_.models);
  command.get_option("MODEL")->required(false);
  command
      .add_option("--reference", shape_.reference,
                  "Fine model of the shape that the others stand for")
      ->group(option_group::kMeasuring)
      ->required()
      ->check(not_empty())
      ->check(suggest_models())
      ->type_name("FILE");
  command
      .add_option("--decimate", shape_.decimate,
                  "Also measure the reference decimated to so many triangles each")
      ->group(option_group::kMeasuring)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(number_from_to<std::size_t>(1, kMostFlatTriangles))
      ->type_name("N,...");
  command
      .add_option("--error", shape_.error,
                  "How far the triangles by which distances are measured may be off a curved "
                  "surface, over the shape's radius, default 1e-4")
      ->group(option_group::kMeasuring)
      ->check(number_from_to(1e-6, 1.0))
      ->type_name("E");
  add_report_folder(command, shape_.output);
  add_size(command, text_.size, fmt::format("{}x{}", shape_.width, shape_.height));
  add_runs(command, shape_.runs);
  add_plots(command, shape_.plots);
  add_device(command, shape_.device);
}

void CommandLine::add_stability() {
  CLI::App& command = subcommand(
      bench_, "stability",
      "Measure errors over distance, scale, grazing angle, aspect and lean of normals, and write a "
      "report with a plot");
  add_report_folder(command, stability_.output);
  command.add_option("--rays", stability_.rays, "Rays for every value, default 100")
      ->group(option_group::kMeasuring)
      ->check(number_from_to(1, 1000000))
      ->type_name("N");
}

void CommandLine::add_terminator() {
  CLI::App& command = subcommand(
      bench_, "terminator",
      "Measure what shadows of flat triangles do to smooth surfaces, with and without what "
      "renderers do about it, and write a report with pictures and plots");
  add_models(command, terminator_.models);
  add_report_folder(command, terminator_.output);
  add_size(command, text_.size, fmt::format("{}x{}", terminator_.width, terminator_.height));
  command
      .add_option("--surface", text_.surface,
                  "How triangles are curved: phong or sphere, default phong")
      ->group(option_group::kSurface)
      ->check(one_of({"phong", "sphere"}))
      ->type_name("NAME");
  add_alpha(command, terminator_.surface.alpha);
  command
      .add_option("--lights", terminator_.lights,
                  "Angles between the directions toward the light and toward the eye, in degrees, "
                  "default 30,60,90,120")
      ->group(option_group::kMeasuring)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(number_from_to(0.0, 180.0))
      ->type_name("DEGREES,...");
  add_runs(command, terminator_.runs);
  add_plots(command, terminator_.plots);
  add_device(command, terminator_.device);
}

int CommandLine::run() {
  if (bench_.got_subcommand("stability")) return bench_stability(stability_);
  if (quick_) {
    pareto_.width = 160;
    pareto_.height = 120;
    pareto_.runs = 2;
    pareto_.ranks = {6, 10, 18};
    pareto_.divisions = {1, 4, 16};
    pareto_.finest_error = 0.0;
  }
  // The options that the other subcommands share.
  const auto apply_frames = [&](TimedModels& options) {
    if (text_.size) parse_size("--size", *text_.size, options.width, options.height);
    if (text_.runs) options.runs = *text_.runs;
  };
  if (bench_.got_subcommand("shape")) {
    if (shape_.models.empty() && shape_.decimate.empty()) {
      throw UsageError("MODEL or --decimate is required.");
    }
    apply_frames(shape_);
    return bench_shape(shape_);
  }
  if (bench_.got_subcommand("terminator")) {
    apply_frames(terminator_);
    if (text_.surface) terminator_.surface.surface = surface_of(*text_.surface);
    std::vector<double>& lights = terminator_.lights;
    std::sort(lights.begin(), lights.end());
    lights.erase(std::unique(lights.begin(), lights.end()), lights.end());
    return bench_terminator(terminator_);
  }
  const auto apply = [&](MeasuredModels& options) {
    apply_frames(options);
    if (text_.surface) options.surfaces = {surface_of(*text_.surface)};
  };
  if (bench_.got_subcommand("pareto")) {
    apply(pareto_);
    return bench_pareto(pareto_);
  }
  if (bench_.got_subcommand("ablation")) {
    apply(ablation_);
    return bench_ablation(ablation_);
  }
  apply(speed_);
  return bench_speed(speed_);
}

}  // namespace trisect::bench
