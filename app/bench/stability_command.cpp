#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/bench/commands.h"
#include "app/bench/gnuplot.h"
#include "app/bench/report_files.h"
#include "app/bench/stability.h"
#include "app/bench/stability_report.h"
#include "app/cli/json_text.h"
#include "app/cli/output.h"
#include "app/cli/provenance.h"
#include "app/report/document.h"

namespace trisect {

using bench::StabilityAxis;

int bench_stability(const StabilityOptions& options) {
  bench::expect_gnuplot();
  const bench::ReportFolder folder(options.output);
  const std::vector<StabilityAxis> axes = bench::measure_stability(options.rays);
  const std::string title = "Numerical stability";
  const std::string program = program_and_date();
  std::vector<report::Block> blocks{
      report::Heading{1, title},
      report::Paragraph{fmt::format(
          "{} rays for each value, Phong Tessellation, by the kernels as C++ in single precision, "
          "which agree with Vulkan's bit for bit. error: the root of the mean square of the "
          "distance off the surface over the scene's radius, over the rays that the oracle "
          "decides; a ray that only one of the two has hitting counts as off by the radius. "
          "robust in the normal shell, the thesis's bisection in the height shell, each judged by "
          "its own surface. Where it is not varied the angle is 50 degrees; distance, scale and "
          "grazing are of a sphere of 80 patches, the others of one patch.",
          options.rays)},
      report::Items{{program}}, report::Picture{"stability.svg", "Errors over what is varied"}};
  for (const StabilityAxis& axis : axes) {
    blocks.emplace_back(report::Heading{2, axis.what});
    blocks.emplace_back(table_of(axis));
  }
  folder.plot("stability", [&](const std::string& terminal, const std::string& file) {
    return plot_script(axes, terminal, file);
  });
  folder.write("stability.csv", csv_of(axes));
  folder.write("stability.json", json_text({{"program", program}, {"curves", json_of(axes)}}));
  folder.write("stability.md", report::markdown_of(blocks));
  folder.write("stability.html", report::html_of(title, blocks, folder.path()));
  say("{}\n", (folder.path() / "stability.md").string());
  return exit_done;
}

}  // namespace trisect
