#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/bench/commands.h"
#include "app/bench/gnuplot.h"
#include "app/bench/report_files.h"
#include "app/bench/shape.h"
#include "app/bench/shape_report.h"
#include "app/cli/cache_folder.h"
#include "app/cli/json_text.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/provenance.h"
#include "app/dispatch/pipeline_store.h"
#include "app/report/document.h"

namespace trisect {
namespace {

using report::Block;

std::vector<Block> report_of(const bench::Shape& shape, const std::vector<std::string>& facts,
                             bool plots) {
  std::vector<Block> blocks{
      report::Heading{1, fmt::format("Nearness to a shape: {}", shape.reference)},
      report::Items{facts},
      report::Paragraph{fmt::format(
          "The shape is the {} triangles of {}. Lengths are over its radius, {:.4g}, half the "
          "diagonal of its bounding box.",
          shape.triangles, shape.reference, shape.radius)},
      report::Items{bench::findings_of(shape)}};
  if (plots) {
    blocks.emplace_back(report::Picture{"shape.svg", "Distances over triangles and time"});
  }
  blocks.insert(
      blocks.end(),
      {report::Heading{2, "Distances"},
       report::Paragraph{
           "Distances are measured on flat triangles that stand for a curved surface. measured to: "
           "no point of the surface is farther from them, and what is less cannot be told. RMS, "
           "p99: of the distance to the shape of points that are spread evenly over them by "
           "chance. largest: the largest distance that was found. at most: no point of the surface "
           "is farther off. back: from the shape to the surface. shading normal, normal: degrees "
           "between the model's interpolated normal, or that of the flat triangles, and the "
           "shape's interpolated one."},
       bench::table_of(shape), report::Heading{2, "Pictures"},
       report::Paragraph{
           "One view. Flat triangles are shaded by the interpolated normals too. wrong pixels: "
           "those that only one of both hits. outline: from each pixel of the outline to the "
           "shape's, in pixels, the mean. Over all pixels, the background among them, RMSE: of "
           "the colours in steps of 8 bits; relMSE: the mean of the squares of their differences "
           "in linear light over 0.01 and the square of the shape's (after Rousselle, Knaus and "
           "Zwicker 2011); SSIM: structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004). "
           "accel: what rays are tried against. ms: of a frame, the median. KB: the scene without "
           "images."},
       bench::pictures_table_of(shape),
       report::Paragraph{"The shape's own triangles, in the same view:"},
       bench::frames_table_of(shape)});
  return blocks;
}

}  // namespace

int bench_shape(const ShapeOptions& options) {
  if (options.plots) bench::expect_gnuplot();
  // Reads all models first, so that a bad one is reported before anything is measured.
  expect_readable(options.models);
  expect_readable({options.reference});
  const gpu::Instance instance(false);
  const gpu::Device device(instance, options.device);
  const PipelineStore store(device, cache_folder());
  const bench::ReportFolder folder(options.output);
  const bench::Shape shape = bench::measure_shape(device, options);
  for (const std::string& finding : bench::findings_of(shape)) say("{}\n", finding);
  if (options.plots) {
    folder.plot("shape", [&](const std::string& terminal, const std::string& file) {
      return bench::plot_script(shape, terminal, file);
    });
  }
  const std::vector<std::string> facts{
      fmt::format("{}, {}", device.report().name, device.report().driver), bench::threads_fact(),
      program_and_date(), bench::frames_fact(options)};
  folder.write("shape.csv",
               fmt::format("# {}\n{}", fmt::join(facts, "\n# "), bench::csv_of(shape)));
  folder.write("shape.json", json_text({{"facts", facts}, {"shape", bench::json_of(shape)}}));
  const std::vector<Block> blocks = report_of(shape, facts, options.plots);
  folder.write("shape.md", report::markdown_of(blocks));
  folder.write("shape.html",
               report::html_of("Nearness to a shape: " + shape.reference, blocks, folder.path()));
  say("{}\n", (folder.path() / "shape.md").string());
  return exit_done;
}

}  // namespace trisect
