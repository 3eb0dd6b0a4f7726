// How near coarse models come to a shape, by their flat triangles and by curved ones.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/bench/frame_errors.h"
#include "app/bench/mesh_distance.h"
#include "app/bench/options.h"
#include "app/buffers/kernel_choice.h"
#include "app/cli/statistics.h"
#include "app/surface/surface_choice.h"
#include "vk/device.h"

namespace trisect::bench {

// A model with one surface against the shape. Lengths are over the shape's radius, half the
// diagonal of its bounding box.
struct ShapeRow {
  std::string model;  // its short name
  std::size_t triangles = 0;
  SurfaceChoice choice;
  Accel accel = Accel::list;  // that traces it
  // Distances are measured on flat triangles: no point of the surface is farther from them. What is
  // less than that cannot be told.
  double off_surface = 0.0;
  Samples samples;           // of the surface, against the shape
  LargestDistance to_shape;  // from the surface
  LargestDistance to_model;  // from the shape to the surface
  std::size_t wrong = 0;     // pixels that only the model or only the shape hits
  OutlineErrors outline;     // 0 if the model is not seen
  double color_rmse = 0.0;   // in steps of 8 bits
  double similarity = 1.0;   // structural_similarity()
  double relative = 0.0;     // relative_square_error()
  Spread ms;
  std::size_t bytes = 0;
};

// The shape's own triangles, drawn by this program or by Embree.
struct ShapeFrame {
  std::string contender;
  Spread ms;
  std::size_t bytes = 0;
};

struct Shape {
  std::string reference;  // its short name
  std::size_t triangles = 0;
  double radius = 0.0;  // in the model's units
  std::vector<ShapeRow> rows;
  std::vector<ShapeFrame> frames;
};

// Measures every model with flat triangles, phong at several alpha, and sphere. Throws InputError,
// for a model that is apart from the reference too, DeviceError, OutOfMemory, Interrupted.
Shape measure_shape(const gpu::Device& device, const ShapeOptions& options);

}  // namespace trisect::bench
