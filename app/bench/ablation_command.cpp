#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/bench/ablation.h"
#include "app/bench/ablation_report.h"
#include "app/bench/commands.h"
#include "app/bench/gnuplot.h"
#include "app/bench/report_files.h"
#include "app/cli/cache_folder.h"
#include "app/cli/json_text.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/provenance.h"
#include "app/dispatch/pipeline_store.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/report/document.h"

namespace trisect {

using bench::Ablation;

int bench_ablation(const AblationOptions& options) {
  bench::expect_gnuplot();
  // Reads all models first, so that a bad one is reported before anything is measured.
  expect_readable(options.models);
  const gpu::Instance instance(false);
  const gpu::Device device(instance, options.device);
  const PipelineStore store(device, cache_folder());
  const bench::ReportFolder folder(options.output);
  std::vector<Ablation> ablations;
  for (const std::string& model : options.models) {
    for (const uint surface : options.surfaces) {
      ablations.push_back(bench::measure_ablation(device, options, model, surface));
    }
  }
  const std::string title = "What each step is worth";
  const std::vector<std::string> facts{
      fmt::format("{}, {}", device.report().name, device.report().driver), program_and_date(),
      bench::frames_fact(options)};
  std::vector<report::Block> blocks{
      report::Heading{1, title},
      report::Paragraph{
          "From the thesis's way of making a frame to this program's, each step by one change to "
          "the step that `from` names. error, wrong and missed: against the oracle, as in the "
          "report of speed against error; each shell is judged by its own surface. Evaluations are "
          "of the field (bisection) or of the surface with its derivatives (robust); candidates "
          "are the triangles or parts that a ray is tried on."},
      report::Items{facts}};
  for (const Ablation& ablation : ablations) {
    const std::string name = name_of(ablation);
    folder.plot(name, [&](const std::string& terminal, const std::string& file) {
      return plot_script(ablation, terminal, file);
    });
    blocks.emplace_back(
        report::Heading{2, fmt::format("{}, {} ({} patches)", ablation.model,
                                       surface_name(ablation.surface), ablation.patches)});
    blocks.emplace_back(report::Picture{name + ".svg", "Milliseconds and wrong pixels, " + name});
    blocks.emplace_back(table_of(ablation));
  }
  folder.write("ablation.json", json_text({{"facts", facts}, {"ablations", json_of(ablations)}}));
  folder.write("ablation.md", report::markdown_of(blocks));
  folder.write("ablation.html", report::html_of(title, blocks, folder.path()));
  say("{}\n", (folder.path() / "ablation.md").string());
  return exit_done;
}

}  // namespace trisect
