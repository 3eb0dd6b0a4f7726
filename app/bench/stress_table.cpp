#include "app/bench/stress_table.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/base/error.h"

namespace trisect::bench {

StressTable read_stress_table(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file + ": cannot be read.");
  try {
    const nlohmann::json json = nlohmann::json::parse(in);
    StressTable result;
    result.device =
        json.at("device").get<std::string>() + ", " + json.at("driver").get<std::string>();
    result.table.rows.push_back({"case", "surface", "shell", "solver", "rays", "undecidable",
                                 "wrong", "missed", "p50 ulp", "p99 ulp", "max ulp", "NaNs",
                                 "evaluations a ray", "verdict"});
    const auto rounded = [](const nlohmann::json& number) {
      return fmt::format("{:.3g}", number.get<double>());
    };
    for (const nlohmann::json& row : json.at("rows")) {
      const std::string note = row.at("note");
      std::string verdict = row.at("verdict");
      if (!note.empty()) verdict += " (" + note + ")";
      result.table.rows.push_back(
          {row.at("case"), row.at("surface"), row.at("shell"), row.at("solver"),
           row.at("rays").dump(), row.at("undecidable").dump(), row.at("wrong").dump(),
           row.at("missed").dump(), rounded(row.at("depth_error_ulp_p50")),
           rounded(row.at("depth_error_ulp_p99")), rounded(row.at("depth_error_ulp_max")),
           row.at("nans").dump(), rounded(row.at("evaluations_per_ray")), verdict});
    }
    return result;
  } catch (const nlohmann::json::exception&) {
    throw InputError(file + ": is not what trisect hardcases --json writes.");
  }
}

}  // namespace trisect::bench
