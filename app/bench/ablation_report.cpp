#include "app/bench/ablation_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace trisect::bench {
namespace {

double times_as_fast(const Ablation& ablation, const Step& step) {
  return ablation.steps[step.from].measurement.ms.median / step.measurement.ms.median;
}

double each_pixel(const Ablation& ablation, uint64_t count) {
  return static_cast<double>(count) / static_cast<double>(ablation.pixels);
}

}  // namespace

std::string name_of(const Ablation& ablation) {
  return ablation.model + "-" + surface_name(ablation.surface);
}

report::Table table_of(const Ablation& ablation) {
  report::Table table{{{"", "change", "from", "ms", "times as fast", "error", "wrong or missed",
                        "evaluations a pixel", "candidates a pixel", "bytes a pixel"}}};
  for (std::size_t i = 0; i < ablation.steps.size(); ++i) {
    const Step& step = ablation.steps[i];
    const Measurement& m = step.measurement;
    const bool first = step.from == i;
    table.rows.push_back({fmt::to_string(i + 1), step.change,
                          first ? "" : fmt::to_string(step.from + 1),
                          fmt::format("{:.1f}", m.ms.median),
                          first ? "" : fmt::format("{:.2f}", times_as_fast(ablation, step)),
                          fmt::format("{:.1e}", m.errors.rms), fmt::to_string(wrong_pixels(m)),
                          fmt::format("{:.1f}", each_pixel(ablation, m.work.evaluations)),
                          fmt::format("{:.2f}", each_pixel(ablation, m.work.candidates)),
                          fmt::format("{:.0f}", each_pixel(ablation, m.work.bytes_read))});
  }
  return table;
}

nlohmann::ordered_json json_of(const std::vector<Ablation>& ablations) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Ablation& ablation : ablations) {
    nlohmann::ordered_json steps = nlohmann::ordered_json::array();
    for (const Step& step : ablation.steps) {
      const Measurement& m = step.measurement;
      steps.push_back({{"change", step.change},
                       {"from", step.from},
                       {"ms", json_of(m.ms)},
                       {"times_as_fast", times_as_fast(ablation, step)},
                       {"rms", m.errors.rms},
                       {"wrong_hits", m.errors.wrong},
                       {"missed", m.errors.missed},
                       {"evaluations", m.work.evaluations},
                       {"candidates", m.work.candidates},
                       {"bytes_read", m.work.bytes_read}});
    }
    all.push_back({{"model", ablation.model},
                   {"surface", surface_name(ablation.surface)},
                   {"patches", ablation.patches},
                   {"steps", steps}});
  }
  return all;
}

// Two panels beside each other: milliseconds, and pixels that are not right.
std::string plot_script(const Ablation& ablation, const std::string& terminal,
                        const std::string& file) {
  std::string script =
      fmt::format("set terminal {}\nset output \"{}\"\n$steps << EOD\n", terminal, file);
  for (std::size_t i = 0; i < ablation.steps.size(); ++i) {
    const Step& step = ablation.steps[i];
    script +=
        fmt::format("{} \"{}: {}\" {} {}\n", i, i + 1, step.change, step.measurement.ms.median,
                    std::max(static_cast<double>(wrong_pixels(step.measurement)), 0.5));
  }
  // Bars to the right, the first step on top. They begin at 0.1, left of both axes: a logarithmic
  // one has no 0.
  return script + fmt::format(
                      "EOD\n"
                      "set multiplot title \"{}, {} patches, {}\"\n"
                      "set style fill solid 0.7\nset grid x\nset logscale x\nset format x "
                      "\"10^{{%L}}\"\nset yrange [{}:-1]\nunset key\n"
                      "set lmargin 46\nset origin 0,0\nset size 0.68,0.94\nset xrange [1:*]\n"
                      "set xlabel \"milliseconds a frame\"\n"
                      "plot $steps using 3:0:(0.1):3:($0-0.35):($0+0.35):ytic(2) with boxxyerror\n"
                      "set lmargin 3\nset origin 0.68,0\nset size 0.32,0.94\nunset ytics\nset "
                      "xrange [0.3:*]\n"
                      "set xlabel \"wrong or missed pixels (none: at 0.5)\"\n"
                      "plot $steps using 4:0:(0.1):4:($0-0.35):($0+0.35) with boxxyerror lc 2\n"
                      "unset multiplot\n",
                      ablation.model, ablation.patches, surface_name(ablation.surface),
                      ablation.steps.size());
}

}  // namespace trisect::bench
