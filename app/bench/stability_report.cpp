#include "app/bench/stability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/bench/gnuplot.h"
#include "app/report/columns.h"

namespace trisect::bench {
namespace {

using report::Columns;
using report::Table;
using report::Value;

struct StabilityRow {
  const StabilityAxis& axis;
  const StabilityCurve& curve;
  const StabilityPoint& point;
};

std::vector<StabilityRow> rows_of(const StabilityAxis& axis, const StabilityCurve& curve) {
  std::vector<StabilityRow> rows;
  for (const StabilityPoint& point : curve.points) rows.push_back({axis, curve, point});
  return rows;
}

Value decided_error(const StabilityRow& row) {
  return row.point.decided > 0 ? Value(row.point.error) : Value();
}

// The same for a reader of the table.
Value error_or_undecided(const StabilityRow& row) {
  return row.point.decided > 0 ? Value(row.point.error) : Value("undecided");
}

// A column stands twice where the outputs have it in different places or show different values.
const Columns<StabilityRow>& stability_columns() {
  // clang-format off
  static const Columns<StabilityRow> columns{
      {{"axis", "{}"}, "", {}, [](auto& r) { return r.axis.name; }},
      {{"solver", "\"{}\""}, "", {}, [](auto& r) { return r.curve.solver; }},
      {{"value", "{:g}"}, "value", {"value", "{:g}"}, [](auto& r) { return r.point.value; }},
      {{"error", "{:.4e}"}, "", {}, [](auto& r) { return r.point.error; }},
      {{}, "", {"error", "{:.1e}"}, error_or_undecided},
      {{"decided", "{}"}, "decided", {}, [](auto& r) { return r.point.decided; }},
      {{"wrong", "{}"}, "wrong", {"wrong", "{}"}, [](auto& r) { return r.point.wrong; }},
      {{"missed", "{}"}, "missed", {"missed", "{}"}, [](auto& r) { return r.point.missed; }},
      {{"nans", "{}"}, "nans", {"NaNs", "{}"}, [](auto& r) { return r.point.nans; }},
      {{}, "error", {}, decided_error},
      {{}, "", {"rays decided", "{}"}, [](auto& r) { return r.point.decided; }},
  };
  // clang-format on
  return columns;
}

}  // namespace

Table table_of(const StabilityAxis& axis) {
  std::vector<Table> solvers;
  for (const StabilityCurve& curve : axis.curves) {
    solvers.push_back(stability_columns().table(rows_of(axis, curve)));
    solvers.back().rows[0][1] = curve.solver + ": error";
  }
  // Side by side: the first and the last column, which the solvers share, stand once.
  Table table = solvers[0];
  table.rows[0][0] = axis.what;
  for (std::size_t k = 1; k < solvers.size(); ++k) {
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const std::vector<std::string>& more = solvers[k].rows[i];
      table.rows[i].insert(table.rows[i].end() - 1, more.begin() + 1, more.end() - 1);
    }
  }
  return table;
}

std::string csv_of(const std::vector<StabilityAxis>& axes) {
  std::vector<StabilityRow> rows;
  for (const StabilityAxis& axis : axes) {
    for (const StabilityCurve& curve : axis.curves) {
      for (const StabilityRow& row : rows_of(axis, curve)) rows.push_back(row);
    }
  }
  return stability_columns().csv(rows);
}

nlohmann::ordered_json json_of(const std::vector<StabilityAxis>& axes) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const StabilityAxis& axis : axes) {
    for (const StabilityCurve& curve : axis.curves) {
      json.push_back({{"axis", axis.name},
                      {"solver", curve.solver},
                      {"points", stability_columns().json(rows_of(axis, curve))}});
    }
  }
  return json;
}

std::string plot_script(const std::vector<StabilityAxis>& axes, const std::string& terminal,
                        const std::string& file) {
  std::string script = fmt::format(
      "set terminal {}\nset output {}\nset multiplot layout 2,3\nset grid\nset logscale y\n"
      "set format y \"10^{{%L}}\"\nset yrange [1e-9:2]\nset key center right\n",
      terminal, gnuplot_text(file));
  for (const StabilityAxis& axis : axes) {
    std::vector<std::string> curves;
    for (std::size_t k = 0; k < axis.curves.size(); ++k) {
      script += fmt::format("${}{} << EOD\n", axis.name, k);
      for (const StabilityPoint& p : axis.curves[k].points) {
        if (p.decided > 0) script += fmt::format("{} {}\n", p.value, std::max(p.error, 1e-9));
      }
      script += "EOD\n";
      curves.push_back(fmt::format("${}{} using 1:2 with linespoints title \"{}\"", axis.name, k,
                                   axis.curves[k].solver));
    }
    script += fmt::format("set xlabel \"{}\"\n{}\nplot {}\n", axis.what,
                          axis.logarithmic ? "set logscale x\nset format x \"10^{%L}\""
                                           : "unset logscale x\nset format x \"%g\"",
                          fmt::join(curves, ", "));
  }
  return script + "unset multiplot\n";
}

}  // namespace trisect::bench
