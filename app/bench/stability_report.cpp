#include "app/bench/stability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace trisect::bench {

report::Table table_of(const StabilityAxis& axis) {
  std::vector<std::string> header{axis.what};
  for (const StabilityCurve& curve : axis.curves) {
    header.push_back(curve.solver + ": error");
    header.emplace_back("wrong");
    header.emplace_back("missed");
    header.emplace_back("NaNs");
  }
  header.emplace_back("rays decided");
  report::Table table{{header}};
  for (std::size_t i = 0; i < axis.curves[0].points.size(); ++i) {
    std::vector<std::string> row{fmt::format("{:g}", axis.curves[0].points[i].value)};
    for (const StabilityCurve& curve : axis.curves) {
      const StabilityPoint& point = curve.points[i];
      row.push_back(point.decided > 0 ? fmt::format("{:.1e}", point.error) : "");
      row.push_back(fmt::to_string(point.wrong));
      row.push_back(fmt::to_string(point.missed));
      row.push_back(fmt::to_string(point.nans));
    }
    row.push_back(fmt::to_string(axis.curves[0].points[i].decided));
    table.rows.push_back(row);
  }
  return table;
}

std::string csv_of(const std::vector<StabilityAxis>& axes) {
  std::string text = "axis,solver,value,error,decided,wrong,missed,nans\n";
  for (const StabilityAxis& axis : axes) {
    for (const StabilityCurve& curve : axis.curves) {
      for (const StabilityPoint& p : curve.points) {
        text += fmt::format("{},\"{}\",{:g},{:.4e},{},{},{},{}\n", axis.name, curve.solver, p.value,
                            p.error, p.decided, p.wrong, p.missed, p.nans);
      }
    }
  }
  return text;
}

nlohmann::ordered_json json_of(const std::vector<StabilityAxis>& axes) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const StabilityAxis& axis : axes) {
    for (const StabilityCurve& curve : axis.curves) {
      nlohmann::ordered_json points = nlohmann::ordered_json::array();
      for (const StabilityPoint& p : curve.points) {
        points.push_back({{"value", p.value},
                          {"decided", p.decided},
                          {"wrong", p.wrong},
                          {"missed", p.missed},
                          {"nans", p.nans}});
        if (p.decided > 0) points.back()["error"] = p.error;
      }
      json.push_back({{"axis", axis.name}, {"solver", curve.solver}, {"points", points}});
    }
  }
  return json;
}

std::string plot_script(const std::vector<StabilityAxis>& axes, const std::string& terminal,
                        const std::string& file) {
  std::string script = fmt::format(
      "set terminal {}\nset output \"{}\"\nset multiplot layout 2,3\nset grid\nset logscale y\n"
      "set format y \"10^{{%L}}\"\nset yrange [1e-9:2]\nset key center right\n",
      terminal, file);
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
