// Shadow terminators: what shadows of flat triangles do to a smooth surface, with and without what
// renderers do about it, against the curved surface's own shadows.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/bench/options.h"
#include "app/cli/statistics.h"
#include "app/frame/frame.h"
#include "vk/device.h"

namespace trisect::bench {

// Of one way to cast shadows on a model in one light. Pixels are those where the surface, its
// shadow and the flat triangles are seen beyond doubt.
struct TerminatorRow {
  std::string model;  // its short name
  std::size_t triangles = 0;
  double light = 0.0;  // degrees between the directions toward it and toward the eye
  std::string shadows;
  std::size_t pixels = 0;
  std::size_t lit = 0;     // of them, in truth
  std::size_t dark = 0;    // wrongly: lit in truth
  std::size_t bright = 0;  // wrongly: in shadow in truth
  double rmse = 0.0;  // of the brightness, which is 1 where light falls on the surface squarely
  Spread ms;          // of a frame with shadows
};

// The way that is none: pixels whose normal faces the light are lit. What is wrongly dark there is
// so because flat triangles are seen in other places, with other normals, than the curved surface.
inline constexpr const char* kNoShadows = "no shadows";

struct Terminator {
  std::vector<TerminatorRow> rows;  // of each model those of each light, the curved surface's first
  std::vector<Frame> sheets;        // for each model, rows of lights, columns of ways
};

// Throws InputError, DeviceError, OutOfMemory, Interrupted.
Terminator measure_terminator(const gpu::Device& device, const TerminatorOptions& options);

}  // namespace trisect::bench
