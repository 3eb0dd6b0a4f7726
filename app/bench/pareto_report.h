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

// Sentences about a scene's measurements: whether the robust solver is on the Pareto front, and how
// its time and error compare with the thesis's bisection and with Embree.
std::vector<std::string> findings_of(const Scene& scene);

// A gnuplot script that draws time over the distance off the surface and time over wrong pixels.
// terminal: gnuplot's terminal with its options. file: where gnuplot writes the picture.
std::string plot_script(const Scene& scene, const std::string& terminal, const std::string& file);

// The same for all scenes with a surface in one, with time in that of the fastest robust contender.
std::string summary_script(const std::vector<Scene>& scenes, uint surface,
                           const std::string& terminal, const std::string& file);

// One row per contender.
report::Table table_of(const Scene& scene);

// The stem of the names of the scene's files, such as "teapot-phong".
std::string name_of(const Scene& scene);

}  // namespace trisect::bench
