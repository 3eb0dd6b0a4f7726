// The report of numerical stability.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/bench/stability.h"
#include "app/report/document.h"

namespace trisect::bench {

// One row per value of what is varied, the solvers side by side.
report::Table table_of(const StabilityAxis& axis);

// One line per axis, solver and value.
std::string csv_of(const std::vector<StabilityAxis>& axes);

// One object per axis and solver, with an array of its points.
nlohmann::ordered_json json_of(const std::vector<StabilityAxis>& axes);

// A gnuplot script that draws the errors over each axis. terminal: gnuplot's terminal with its
// options. file: where gnuplot writes the picture.
std::string plot_script(const std::vector<StabilityAxis>& axes, const std::string& terminal,
                        const std::string& file);

}  // namespace trisect::bench
