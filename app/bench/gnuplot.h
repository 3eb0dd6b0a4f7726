// Draws plots with the program gnuplot.
#pragma once

#include <string>

namespace trisect::bench {

// Throws InputError if gnuplot is not installed.
void expect_gnuplot();

// Runs a script. Throws InputError if gnuplot fails.
void run_gnuplot(const std::string& script);

}  // namespace trisect::bench
