#include "app/bench/ablation_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/bench/gnuplot.h"
#include "app/report/columns.h"

namespace trisect::bench {
namespace {

using report::Columns;
using report::Value;

struct AblationRow {
  const Ablation& ablation;
  std::size_t index;  // of the step

  [[nodiscard]] const Step& step() const { return ablation.steps[index]; }
  [[nodiscard]] const Measurement& measurement() const { return step().measurement; }
  [[nodiscard]] bool first() const { return step().from == index; }
  [[nodiscard]] double times_as_fast() const {
    return ablation.steps[step().from].measurement.ms.median / measurement().ms.median;
  }
  [[nodiscard]] double per_pixel(uint64_t count) const {
    return static_cast<double>(count) / static_cast<double>(ablation.pixels);
  }
};

std::vector<AblationRow> rows_of(const Ablation& ablation) {
  std::vector<AblationRow> rows;
  for (std::size_t i = 0; i < ablation.steps.size(); ++i) rows.push_back({ablation, i});
  return rows;
}

// A column stands twice where the outputs show different values.
const Columns<AblationRow>& ablation_columns() {
  // clang-format off
  static const Columns<AblationRow> columns{
      {{}, "", {"", "{}"}, [](auto& r) { return r.index + 1; }},
      {{}, "change", {"change", "{}"}, [](auto& r) { return r.step().change; }},
      {{}, "from", {}, [](auto& r) { return r.step().from; }},
      {{}, "", {"from", "{}"}, [](auto& r) { return r.first() ? Value() : Value(r.step().from + 1); }},
      {{}, "ms.min", {}, [](auto& r) { return r.measurement().ms.min; }},
      {{}, "ms.median", {"ms", "{:.1f}"}, [](auto& r) { return r.measurement().ms.median; }},
      {{}, "ms.max", {}, [](auto& r) { return r.measurement().ms.max; }},
      {{}, "times_as_fast", {}, [](auto& r) { return r.times_as_fast(); }},
      {{}, "", {"times as fast", "{:.2f}"}, [](auto& r) { return r.first() ? Value() : Value(r.times_as_fast()); }},
      {{}, "rms", {"error", "{:.1e}"}, [](auto& r) { return r.measurement().errors.rms; }},
      {{}, "wrong_hits", {}, [](auto& r) { return r.measurement().errors.wrong; }},
      {{}, "missed", {}, [](auto& r) { return r.measurement().errors.missed; }},
      {{}, "", {"wrong or missed", "{}"}, [](auto& r) { return wrong_pixels(r.measurement()); }},
      {{}, "evaluations", {}, [](auto& r) { return r.measurement().work.evaluations; }},
      {{}, "candidates", {}, [](auto& r) { return r.measurement().work.candidates; }},
      {{}, "bytes_read", {}, [](auto& r) { return r.measurement().work.bytes_read; }},
      {{}, "", {"evaluations a pixel", "{:.1f}"}, [](auto& r) { return r.per_pixel(r.measurement().work.evaluations); }},
      {{}, "", {"candidates a pixel", "{:.2f}"}, [](auto& r) { return r.per_pixel(r.measurement().work.candidates); }},
      {{}, "", {"bytes a pixel", "{:.0f}"}, [](auto& r) { return r.per_pixel(r.measurement().work.bytes_read); }},
  };
  // clang-format on
  return columns;
}

}  // namespace

std::string name_of(const Ablation& ablation) {
  return ablation.model + "-" + surface_name(ablation.surface);
}

report::Table table_of(const Ablation& ablation) {
  return ablation_columns().table(rows_of(ablation));
}

nlohmann::ordered_json json_of(const std::vector<Ablation>& ablations) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Ablation& ablation : ablations) {
    all.push_back({{"model", ablation.model},
                   {"surface", surface_name(ablation.surface)},
                   {"patches", ablation.patches},
                   {"steps", ablation_columns().json(rows_of(ablation))}});
  }
  return all;
}

std::string plot_script(const Ablation& ablation, const std::string& terminal,
                        const std::string& file) {
  std::string script = page(terminal, file, "",
                            fmt::format("{}, {} patches, {}", ablation.model, ablation.patches,
                                        surface_name(ablation.surface))) +
                       "$steps << EOD\n";
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
                      ablation.steps.size());
}

}  // namespace trisect::bench
