// The report of shadow terminators.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/bench/terminator.h"
#include "app/report/document.h"

namespace trisect::bench {

// Rows of one model and one way to cast shadows as one of all lights, in the order in which they
// come: pixels added up, the error over all of them, the time of a frame their mean.
std::vector<TerminatorRow> over_lights(const std::vector<TerminatorRow>& rows);

// A line for every model, light and way, under a line of names.
std::string csv_of(const std::vector<TerminatorRow>& rows);
nlohmann::ordered_json json_of(const std::vector<TerminatorRow>& rows);
report::Table table_of(const std::vector<TerminatorRow>& rows);
// Without the light.
report::Table summary_table_of(const std::vector<TerminatorRow>& rows);

// A sentence for every model: what part of what is lit the curved surface, flat triangles, and the
// best of the ways about them leave in the dark, or that nothing is lit.
std::vector<std::string> findings_of(const std::vector<TerminatorRow>& rows);

// A gnuplot script that draws the share of wrongly dark pixels and the error of brightness over the
// light's angle, for the rows of one model. terminal, file: as of the other reports.
std::string terminator_plot(const std::vector<TerminatorRow>& rows, const std::string& terminal,
                            const std::string& file);

}  // namespace trisect::bench
