#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/bench/commands.h"
#include "app/bench/gnuplot.h"
#include "app/bench/report_files.h"
#include "app/bench/shape_report.h"
#include "app/bench/terminator.h"
#include "app/bench/terminator_report.h"
#include "app/cli/cache_folder.h"
#include "app/cli/json_text.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/provenance.h"
#include "app/dispatch/pipeline_store.h"
#include "app/mesh/obj_file.h"
#include "app/picture/image_file.h"
#include "app/report/document.h"

namespace trisect {
namespace {

using report::Block;

std::vector<Block> report_of(const std::vector<bench::TerminatorRow>& rows,
                             const std::vector<std::string>& models,
                             const std::vector<std::string>& facts, bool plots) {
  std::vector<Block> blocks{
      report::Heading{1, "Shadow terminators"}, report::Items{facts},
      report::Paragraph{
          "Where a coarse model with smooth normals turns from the light, the shadows of its flat "
          "triangles fall in steps. The curved surface has hardly any of its own, where its "
          "patches meet (docs/shadows.md measures them). The truth here is the curved surface, by "
          "an independent search in double precision: that curved shadows leave nothing wrong says "
          "that the program draws its surface right. Pixels whose answer the roundings of single "
          "precision decide, or at which only the flat or only the curved surface is seen, are "
          "left out."},
      report::Items{bench::findings_of(rows)}};
  for (const std::string& model : models) {
    blocks.emplace_back(report::Heading{2, model});
    blocks.emplace_back(report::Picture{model + "-lights.png", "Light and shadow, " + model});
    if (plots) {
      blocks.emplace_back(report::Picture{model + "-errors.svg", "Wrong pixels, " + model});
    }
  }
  blocks.insert(
      blocks.end(),
      {report::Heading{2, "All lights"},
       report::Paragraph{
           "flat: shadow rays begin on the flat triangle. offset: so far off it, over the mean "
           "edge. Hanika 2021: on the interpolated tangent planes of the vertices (Ray Tracing "
           "Gems II, chapter 4). Cycles: the geometry offset of Blender 2.90 and later, with its "
           "threshold of 0.1. Chiang 2019: on the triangle, and what is lit beside is dimmed to "
           "soften the edge (Chiang, Li and Burley, Taming the shadow terminator). no shadows: "
           "what faces the light is lit; what is wrongly dark there is so because flat triangles "
           "are seen in other places, with other normals, than the surface. wrongly dark: lit in "
           "truth. wrongly bright: in shadow in truth. RMSE: of the brightness, the cosine between "
           "light and interpolated normal. ms: of a frame with its shadows; of curved ones by the "
           "clock "
           "of the device above, of flat ones, which are traced ray by ray with Embree, by the "
           "host's."},
       bench::summary_table_of(bench::over_lights(rows)), report::Heading{2, "Each light"},
       report::Paragraph{"light: degrees between the directions toward the light and the eye."},
       bench::table_of(rows)});
  return blocks;
}

// Models' pictures are named after them.
void expect_distinct_names(const std::vector<std::string>& models) {
  std::vector<std::string> names;
  names.reserve(models.size());
  for (const std::string& model : models) names.push_back(model_name(model));
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice == names.end()) return;
  throw UsageError(fmt::format("two models are named {}, and so would be their pictures.", *twice));
}

}  // namespace

int bench_terminator(const TerminatorOptions& options) {
  if (options.plots) bench::expect_gnuplot();
  expect_readable(options.models);
  expect_distinct_names(options.models);
  const gpu::Instance instance(false);
  const gpu::Device device(instance, options.device);
  const PipelineStore store(device, cache_folder());
  const bench::ReportFolder folder(options.output);
  const bench::Terminator measured = bench::measure_terminator(device, options);
  const std::vector<bench::TerminatorRow>& rows = measured.rows;
  for (const std::string& finding : bench::findings_of(rows)) say("{}\n", finding);
  std::vector<std::string> models;
  for (std::size_t k = 0; k < options.models.size(); ++k) {
    const std::string& model = models.emplace_back(model_name(options.models[k]));
    save_image(measured.sheets[k], folder.path() / (model + "-lights.png"));
    if (!options.plots) continue;
    std::vector<bench::TerminatorRow> own;
    for (const bench::TerminatorRow& row : rows) {
      if (row.model == model) own.push_back(row);
    }
    folder.plot(model + "-errors", [&](const std::string& terminal, const std::string& file) {
      return bench::terminator_plot(own, terminal, file);
    });
  }
  const std::vector<std::string> facts{
      fmt::format("{}, {}", device.report().name, device.report().driver), bench::threads_fact(),
      program_and_date(), bench::frames_fact(options),
      "surface: " + bench::surface_text(options.surface)};
  folder.write("terminator.csv",
               fmt::format("# {}\n{}", fmt::join(facts, "\n# "), bench::csv_of(rows)));
  folder.write("terminator.json", json_text({{"facts", facts}, {"rows", bench::json_of(rows)}}));
  const std::vector<Block> blocks = report_of(rows, models, facts, options.plots);
  folder.write("terminator.md", report::markdown_of(blocks));
  folder.write("terminator.html", report::html_of("Shadow terminators", blocks, folder.path()));
  say("{}\n", (folder.path() / "terminator.md").string());
  return exit_done;
}

}  // namespace trisect
