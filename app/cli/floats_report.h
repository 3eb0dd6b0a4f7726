// The table of `trisect devices --floats`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/accuracy/float_operations.h"
#include "app/report/columns.h"

namespace trisect {

struct FloatRow {
  std::string operation;
  std::string measured;
  std::string promised;  // by the Vulkan specification, without the declarations of FloatControls
  std::string relied;    // whether the kernels rely on it, and for what
};

std::vector<FloatRow> float_rows(const FloatReport& report);
const report::Columns<FloatRow>& float_columns();

// The figures of the report, each under its name.
nlohmann::ordered_json float_figures(const FloatReport& report);

}  // namespace trisect
