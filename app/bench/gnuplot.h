// Draws plots with the program gnuplot.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trisect::bench {

// Throws InputError if gnuplot is not installed.
void expect_gnuplot();

// Runs a script. Throws InputError if gnuplot fails.
void run_gnuplot(const std::string& script);

// A text as a string of a script, whatever is in it: gnuplot runs what stands between back-quotes
// in strings of double quotes.
std::string gnuplot_text(const std::string& text);

// Those of the names that differ, in the order in which they come first.
std::vector<std::string> distinct(const std::vector<std::string>& names);

// The point, the colour and the title of the k-th of curves with these names: no two have the same.
std::string curve_style(const std::vector<std::string>& names, std::size_t k);

// How a script begins that draws several panels on a page. terminal, file: as plot_script() takes
// them. layout: "1,2", or empty.
std::string page(const std::string& terminal, const std::string& file, const std::string& layout,
                 const std::string& title);

// The same for two panels side by side, both of whose axes are logarithmic.
std::string two_panels(const std::string& terminal, const std::string& file,
                       const std::string& title);

}  // namespace trisect::bench
