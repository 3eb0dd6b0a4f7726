#include "app/bench/terminator_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "app/bench/gnuplot.h"
#include "app/report/columns.h"

namespace trisect::bench {
namespace {

using report::Columns;
using report::Value;

// Nothing of nothing.
Value percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? Value()
                    : Value(100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

// Of what is lit in truth.
Value dark_percent(const TerminatorRow& row) {
  return percent(row.dark, row.lit);
}

// Of what is in shadow in truth.
Value bright_percent(const TerminatorRow& row) {
  return percent(row.bright, row.pixels - row.lit);
}

Value error(const TerminatorRow& row) {
  return row.pixels == 0 ? Value() : Value(row.rmse);
}

const Columns<TerminatorRow>& terminator_columns() {
  // clang-format off
  static const Columns<TerminatorRow> columns{
      {{"model", "{}"}, "model", {"model", "{}"}, [](auto& r) { return r.model; }},
      {{"triangles", "{}"}, "triangles", {}, [](auto& r) { return r.triangles; }},
      {{"light", "{:g}"}, "light_degrees", {"light", "{:g}"}, [](auto& r) { return r.light; }},
      {{"shadows", "\"{}\""}, "shadows", {"shadows", "{}"}, [](auto& r) { return r.shadows; }},
      {{"pixels", "{}"}, "pixels", {"pixels", "{}"}, [](auto& r) { return r.pixels; }},
      {{"lit", "{}"}, "lit", {"lit", "{}"}, [](auto& r) { return r.lit; }},
      {{"dark", "{}"}, "wrongly_dark", {"wrongly dark", "{}"}, [](auto& r) { return r.dark; }},
      {{"bright", "{}"}, "wrongly_bright", {"wrongly bright", "{}"}, [](auto& r) { return r.bright; }},
      {{"rmse", "{:.4e}"}, "brightness_rmse", {"RMSE", "{:.1e}"}, error},
      {{"ms_min", "{:.3f}"}, "ms.min", {}, [](auto& r) { return r.ms.min; }},
      {{"ms_median", "{:.3f}"}, "ms.median", {"ms", "{:.1f}"}, [](auto& r) { return r.ms.median; }},
      {{"ms_max", "{:.3f}"}, "ms.max", {}, [](auto& r) { return r.ms.max; }},
  };
  // clang-format on
  return columns;
}

const Columns<TerminatorRow>& summary_columns() {
  // clang-format off
  static const Columns<TerminatorRow> columns{
      {{}, "", {"model", "{}"}, [](auto& r) { return r.model; }},
      {{}, "", {"triangles", "{}"}, [](auto& r) { return r.triangles; }},
      {{}, "", {"shadows", "{}"}, [](auto& r) { return r.shadows; }},
      {{}, "", {"lit", "{}"}, [](auto& r) { return r.lit; }},
      {{}, "", {"wrongly dark", "{}"}, [](auto& r) { return r.dark; }},
      {{}, "", {"% of lit", "{:.2f}"}, dark_percent},
      {{}, "", {"wrongly bright", "{}"}, [](auto& r) { return r.bright; }},
      {{}, "", {"% of shadow", "{:.2f}"}, bright_percent},
      {{}, "", {"RMSE", "{:.1e}"}, error},
      {{}, "", {"ms", "{:.1f}"}, [](auto& r) { return r.ms.median; }},
  };
  // clang-format on
  return columns;
}

std::size_t wrong(const TerminatorRow& row) {
  return row.dark + row.bright;
}

// The ways about flat shadows that leave the fewest pixels wrong: those of a model from the third
// row on but for no shadows.
std::vector<const TerminatorRow*> best_of(std::span<const TerminatorRow> rows) {
  std::vector<const TerminatorRow*> best;
  for (const TerminatorRow& row : rows) {
    if (row.shadows == kNoShadows) continue;
    if (!best.empty() && wrong(row) < wrong(*best.front())) best.clear();
    if (best.empty() || wrong(row) == wrong(*best.front())) best.push_back(&row);
  }
  return best;
}

std::string wrong_text(const TerminatorRow& row) {
  return fmt::format("{} ({:.2g}%) wrongly dark and {} wrongly bright", row.dark,
                     dark_percent(row).get<double>(), row.bright);
}

// Of the rows of a model: the curved surface's, flat triangles', and what others do.
std::string finding_of(std::span<const TerminatorRow> rows) {
  const TerminatorRow& curved = rows[0];
  const std::string begin = fmt::format("{}, {} triangles", curved.model, curved.triangles);
  if (curved.lit == 0) return begin + ": nothing that is seen is lit.";
  std::string text =
      fmt::format("{}, of {} pixels that are lit: curved shadows leave {}; flat ones {}", begin,
                  curved.lit, wrong_text(curved), wrong_text(rows[1]));
  const std::vector<const TerminatorRow*> best = best_of(rows.subspan(2));
  if (best.empty()) return text + ".";
  std::vector<std::string> names;
  names.reserve(best.size());
  for (const TerminatorRow* row : best) names.push_back(row->shadows);
  return fmt::format("{}; of what renderers do about it, the best ({}) leaves {}.", text,
                     fmt::join(names, "; "), wrong_text(*best.front()));
}

}  // namespace

std::vector<TerminatorRow> over_lights(const std::vector<TerminatorRow>& rows) {
  std::vector<TerminatorRow> sums;
  for (const TerminatorRow& row : rows) {
    const auto same = std::find_if(sums.begin(), sums.end(), [&](const TerminatorRow& sum) {
      return sum.model == row.model && sum.shadows == row.shadows;
    });
    if (same == sums.end()) {
      sums.push_back(row);
      continue;
    }
    const double squares = same->rmse * same->rmse * static_cast<double>(same->pixels) +
                           row.rmse * row.rmse * static_cast<double>(row.pixels);
    same->pixels += row.pixels;
    same->lit += row.lit;
    same->dark += row.dark;
    same->bright += row.bright;
    same->rmse = same->pixels == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(same->pixels));
    same->ms.median += row.ms.median;
  }
  // Each has a row for every light.
  for (TerminatorRow& sum : sums) {
    sum.ms.median *= static_cast<double>(sums.size()) / static_cast<double>(rows.size());
  }
  return sums;
}

std::string csv_of(const std::vector<TerminatorRow>& rows) {
  return terminator_columns().csv(rows);
}

nlohmann::ordered_json json_of(const std::vector<TerminatorRow>& rows) {
  return terminator_columns().json(rows);
}

report::Table table_of(const std::vector<TerminatorRow>& rows) {
  return terminator_columns().table(rows);
}

report::Table summary_table_of(const std::vector<TerminatorRow>& rows) {
  return summary_columns().table(rows);
}

std::vector<std::string> findings_of(const std::vector<TerminatorRow>& rows) {
  const std::vector<TerminatorRow> sums = over_lights(rows);
  std::vector<std::string> findings;
  // Rows of a model follow each other.
  for (auto first = sums.begin(); first != sums.end();) {
    const auto end = std::find_if(
        first, sums.end(), [&](const TerminatorRow& row) { return row.model != first->model; });
    findings.push_back(finding_of({first, end}));
    first = end;
  }
  return findings;
}

std::string terminator_plot(const std::vector<TerminatorRow>& rows, const std::string& terminal,
                            const std::string& file) {
  std::vector<std::string> all;
  all.reserve(rows.size());
  for (const TerminatorRow& row : rows) all.push_back(row.shadows);
  const std::vector<std::string> names = distinct(all);
  std::string script =
      two_panels(terminal, file,
                 fmt::format("{}, {} triangles", rows.front().model, rows.front().triangles)) +
      "unset logscale\nset yrange [0:*]\n";
  for (std::size_t k = 0; k < names.size(); ++k) {
    script += fmt::format("$way{} << EOD\n", k);
    for (const TerminatorRow& row : rows) {
      if (row.shadows != names[k]) continue;
      if (row.lit == 0) continue;
      script += fmt::format("{} {} {}\n", row.light, dark_percent(row).get<double>(), row.rmse);
    }
    script += "EOD\n";
  }
  const auto curves = [&](int column) {
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < names.size(); ++k) {
      parts.push_back(
          fmt::format("$way{} using 1:{} with linespoints {}", k, column, curve_style(names, k)));
    }
    return fmt::format("plot {}\n", fmt::join(parts, ", "));
  };
  return script + fmt::format(
                      "set xlabel \"degrees between light and eye\"\n"
                      "set ylabel \"wrongly dark, % of what is lit\"\n{}"
                      "set ylabel \"error of the brightness, RMS\"\n{}unset multiplot\n",
                      curves(2), curves(3));
}

}  // namespace trisect::bench
