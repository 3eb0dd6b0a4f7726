// The report of how near models come to a shape.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/bench/shape.h"
#include "app/report/document.h"

namespace trisect::bench {

// "flat", "phong, alpha 0.65" or "sphere".
std::string surface_text(const SurfaceChoice& choice);

// A line for every model and surface, under a line of names.
std::string csv_of(const Shape& shape);
nlohmann::ordered_json json_of(const Shape& shape);
report::Table table_of(const Shape& shape);
// Of the pictures, times and memory.
report::Table pictures_table_of(const Shape& shape);
// Of the shape's own triangles.
report::Table frames_table_of(const Shape& shape);

// A sentence for every model with the curved surface that is the nearest to the shape: how many
// flat triangles are as near, and which part of their time and memory it takes; or that it is no
// nearer than its flat triangles.
std::vector<std::string> findings_of(const Shape& shape);

// A gnuplot script that draws distances over triangles and over time. terminal: gnuplot's terminal
// with its options. file: where gnuplot writes the picture.
std::string plot_script(const Shape& shape, const std::string& terminal, const std::string& file);

}  // namespace trisect::bench
