// The table and the JSON of `trisect bench speed`.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "app/cli/statistics.h"
#include "app/report/columns.h"
#include "app/surface/shared.h"

namespace trisect::bench {

// The measurements of one contender on one model with one surface.
struct SpeedRow {
  std::string model;  // path of the file
  uint surface = SURFACE_PHONG;
  std::size_t patches = 0;
  std::string contender;
  Spread ms;
  Spread cpu_ms;
  double thesis_ms = 0.0;  // median of the thesis's tracer
  double floor_ms = 0.0;   // median of writing an image and nothing else
  // Neither of these if the contender's image shows no scene.
  std::optional<std::size_t> checked_pixels;
  std::optional<std::size_t> wrong_pixels;
  std::size_t bytes = 0;           // of the scene, without images
  std::optional<double> build_ms;  // for the structure that rays are traced through
  // Of contenders that trace flat triangles in the place of the surface: how many, and how far off
  // they are, over the scene's radius.
  std::optional<std::size_t> flat_triangles;
  std::optional<double> flat_error;
};

const report::Columns<SpeedRow>& speed_columns();

}  // namespace trisect::bench
