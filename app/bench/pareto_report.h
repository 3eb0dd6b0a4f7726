// The report of time against error.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/bench/pareto.h"
#include "app/report/document.h"

namespace trisect::bench {

// A line for every measurement, under a line of names.
std::string csv_of(const std::vector<Scene>& scenes);
nlohmann::ordered_json json_of(const std::vector<Scene>& scenes);

// What a scene's measurements say: of the claims that robust is the fastest at its error, each true
// or not.
std::vector<std::string> findings_of(const Scene& scene);

// A script for gnuplot: time over error, and time over pixels that are wrong. terminal: gnuplot's,
// with options.
std::string plot_script(const Scene& scene, const std::string& terminal, const std::string& file);

// The scene's table.
report::Table table_of(const Scene& scene);

// "teapot-phong": of its files.
std::string name_of(const Scene& scene);

}  // namespace trisect::bench
