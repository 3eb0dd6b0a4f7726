// The report of what each step from the thesis's tracer to this program's is worth.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/bench/ablation.h"
#include "app/report/document.h"

namespace trisect::bench {

// One row per step.
report::Table table_of(const Ablation& ablation);

nlohmann::ordered_json json_of(const std::vector<Ablation>& ablations);

// A gnuplot script that draws milliseconds and wrong pixels of every step. terminal: gnuplot's
// terminal with its options. file: where gnuplot writes the picture.
std::string plot_script(const Ablation& ablation, const std::string& terminal,
                        const std::string& file);

// The stem of the names of the picture's files, such as "teapot-phong".
std::string name_of(const Ablation& ablation);

}  // namespace trisect::bench
