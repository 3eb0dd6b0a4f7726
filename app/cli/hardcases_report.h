// The table and the JSON of `trisect hardcases`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/stress/stress_judge.h"

namespace trisect {

// Aligned text, a line at a time, so that rows can be printed as soon as they are measured.
std::string hardcases_header();
std::string hardcases_row(const StressRow& row);

nlohmann::ordered_json json_of(const StressRow& row);

}  // namespace trisect
