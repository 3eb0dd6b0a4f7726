#include "app/bench/stress_table.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/base/read_file.h"
#include "app/cli/hardcases_report.h"
#include "app/report/columns.h"

namespace trisect::bench {

using report::Value;

StressTable read_stress_table(const std::string& file) {
  const std::string text = read_file(file);
  try {
    const Value json = Value::parse(text);
    StressTable result;
    result.device =
        json.at("device").get<std::string>() + ", " + json.at("driver").get<std::string>();
    result.table = hardcases_columns().table({});
    for (const Value& row : json.at("rows")) {
      std::vector<std::string> cells;
      for (const auto& column : hardcases_columns()) {
        if (column.table.format.empty()) continue;
        const Value& value = row.at(column.json);
        // JSON that another program has written anew may have 0 for 0.0.
        const bool rounded = value.is_number() && column.table.format != "{}";
        cells.push_back(cell_of(column.table, rounded ? Value(value.get<double>()) : value));
      }
      cells.back() = with_note(cells.back(), row.at("note"));
      result.table.rows.push_back(cells);
    }
    return result;
  } catch (const nlohmann::json::exception&) {
    throw InputError(file + ": is not what trisect hardcases --json writes.");
  }
}

}  // namespace trisect::bench
