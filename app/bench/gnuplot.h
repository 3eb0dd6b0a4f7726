// Draws plots with the program gnuplot.
#pragma once

#include <cstddef>
#include <string>

namespace trisect::bench {

// Throws InputError if gnuplot is not installed.
void expect_gnuplot();

// Runs a script. Throws InputError if gnuplot fails.
void run_gnuplot(const std::string& script);

// For `lc rgb`: the k-th of `count` colours, no two of which are the same.
std::string gnuplot_color(std::size_t k, std::size_t count);

}  // namespace trisect::bench
