#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/bench/commands.h"
#include "app/bench/gnuplot.h"
#include "app/bench/pareto.h"
#include "app/bench/pareto_report.h"
#include "app/bench/report_files.h"
#include "app/bench/stress_table.h"
#include "app/cli/cache_folder.h"
#include "app/cli/json_text.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/provenance.h"
#include "app/crosscheck/comparison_picture.h"
#include "app/dispatch/pipeline_store.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/opengl/context.h"
#include "app/picture/image_file.h"
#include "app/report/document.h"

namespace trisect {
namespace {

using report::Block;

// The context is null if OpenGL is not measured.
std::vector<std::string> provenance(const gpu::Device& device, const opengl::Context* context,
                                    const ParetoOptions& options) {
  return {fmt::format("Vulkan: {}, {}", device.report().name, device.report().driver),
          context == nullptr ? "OpenGL: left out"
                             : fmt::format("OpenGL: {}, {}", context->device(), context->driver()),
          bench::threads_fact(), program_and_date(), bench::frames_fact(options)};
}

// The surfaces with which there is more than one scene.
std::vector<uint> summarized(const std::vector<bench::Scene>& scenes) {
  std::map<uint, int> counts;
  for (const bench::Scene& scene : scenes) ++counts[scene.surface];
  std::vector<uint> surfaces;
  for (const auto& [surface, count] : counts) {
    if (count > 1) surfaces.push_back(surface);
  }
  return surfaces;
}

std::string summary_name(uint surface) {
  return fmt::format("summary-{}", surface_name(surface));
}

std::vector<Block> report_of(const std::vector<bench::Scene>& scenes,
                             const std::vector<std::string>& facts, bool plots,
                             const std::optional<bench::StressTable>& hard) {
  std::vector<Block> blocks;
  blocks.emplace_back(report::Heading{1, "Speed against error"});
  blocks.emplace_back(report::Items{facts});
  blocks.emplace_back(report::Paragraph{
      "Every contender draws the same pixels with the same shading. error: the root of the mean "
      "square of the distance off the true surface over the scene's radius, over all pixels that "
      "it or the oracle hits; a pixel that only one of them hits counts as off by the radius. The "
      "oracle is an independent search in double precision; pixels that it cannot decide are left "
      "out. The height shell's surface is judged by its own truth. off: that distance where both "
      "hit. normal: degrees between geometric normals (flat triangles give the surface's own at "
      "the point that they stand for). outline: from each pixel of the frame's outline to the "
      "true one, in pixels, the mean. RMSE and PSNR: of the colours, in steps of 8 bits and in "
      "decibels. MB read: of the scene by this program's rays on their way to the surface, each "
      "its own loads. KB: the scene without images. front: nothing is both faster and more exact. "
      "In the plots rings are around what nothing else is before on the axes that are drawn."});
  if (plots) {
    for (const uint surface : summarized(scenes)) {
      blocks.emplace_back(report::Picture{
          summary_name(surface) + ".svg",
          fmt::format("Time over distance and over wrong pixels, {}", surface_name(surface))});
    }
  }
  for (const bench::Scene& scene : scenes) {
    const std::string name = bench::name_of(scene);
    blocks.emplace_back(
        report::Heading{2, fmt::format("{}, {} ({} patches)", scene.model,
                                       surface_name(scene.surface), scene.patches)});
    if (plots) {
      blocks.emplace_back(
          report::Picture{name + ".svg", "Time over distance and over wrong pixels, " + name});
    }
    blocks.emplace_back(report::Items{bench::findings_of(scene)});
    blocks.emplace_back(bench::table_of(scene));
    blocks.emplace_back(report::Paragraph{
        "The truth in the height shell, the thesis's bisection at Rank 10, their difference and "
        "where they differ:"});
    blocks.emplace_back(report::Picture{name + "-thesis.png", "Four pictures, " + name});
  }
  if (hard) {
    blocks.emplace_back(report::Heading{2, "Hard cases"});
    blocks.emplace_back(report::Paragraph{
        "`trisect hardcases` on " + hard->device +
        ". ulp: depth error across the surface in units of 2^-23 of the scene's radius (in images "
        "of the eye's distance). The robust solver must pass in the normal shell; the height "
        "shell's rows and the thesis's show what is lost there."});
    blocks.emplace_back(hard->table);
  }
  return blocks;
}

}  // namespace

int bench_pareto(const ParetoOptions& options) {
  if (options.plots) bench::expect_gnuplot();
  // Reads all models first, so that a bad one is reported before anything is measured.
  expect_readable(options.models);
  std::optional<bench::StressTable> hard;
  if (!options.hardcases.empty()) hard = bench::read_stress_table(options.hardcases);
  const gpu::Instance instance(false);
  const gpu::Device device(instance, options.device);
  const PipelineStore store(device, cache_folder());
  std::optional<opengl::Context> context;
  if (options.opengl) context.emplace();
  const bench::ReportFolder folder(options.output);
  std::vector<bench::Scene> scenes;
  for (const std::string& model : options.models) {
    for (const uint surface : options.surfaces) {
      scenes.push_back(bench::measure_scene(device, options, model, surface));
      const bench::Scene& scene = scenes.back();
      say("{}, {}\n", scene.model, surface_name(surface));
      for (const std::string& finding : bench::findings_of(scene)) say("  {}\n", finding);
    }
  }
  const std::vector<std::string> facts = provenance(device, context ? &*context : nullptr, options);
  for (const bench::Scene& scene : scenes) {
    const std::string name = bench::name_of(scene);
    if (options.plots) {
      folder.plot(name, [&](const std::string& terminal, const std::string& file) {
        return bench::plot_script(scene, terminal, file);
      });
    }
    save_image(comparison_picture(scene.truth, scene.thesis),
               folder.path() / (name + "-thesis.png"));
  }
  if (options.plots) {
    for (const uint surface : summarized(scenes)) {
      folder.plot(summary_name(surface), [&](const std::string& terminal, const std::string& file) {
        return bench::summary_script(scenes, surface, terminal, file);
      });
    }
  }
  folder.write("report.csv",
               fmt::format("# {}\n{}", fmt::join(facts, "\n# "), bench::csv_of(scenes)));
  folder.write("report.json", json_text({{"facts", facts}, {"scenes", bench::json_of(scenes)}}));
  const std::vector<Block> blocks = report_of(scenes, facts, options.plots, hard);
  folder.write("report.md", report::markdown_of(blocks));
  folder.write("report.html", report::html_of("Speed against error", blocks, folder.path()));
  say("{}\n", (folder.path() / "report.md").string());
  return exit_done;
}

}  // namespace trisect
