// Measures time against error of all ways to draw a model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/bench/comparison.h"
#include "app/bench/options.h"
#include "app/frame/frame.h"
#include "vk/device.h"

namespace trisect::bench {

// One model with one surface.
struct Scene {
  std::string model;  // its short name
  uint surface = SURFACE_PHONG;
  std::size_t patches = 0;
  std::vector<Measurement> measurements;
  // For the report's pictures, in the height shell: the oracle's frame, and the thesis's bisection
  // at Rank 10.
  Frame truth;
  Frame thesis;
};

constexpr const char* kRobustTiles = "robust, tiles";
constexpr const char* kThesisHeight = "thesis, height shell";
constexpr const char* kRasterizer = "OpenGL tessellation";

// Measures all contenders in turns. An OpenGL context must be current, if OpenGL is measured.
// Throws InputError and DeviceError.
Scene measure_scene(const gpu::Device& device, const ParetoOptions& options,
                    const std::string& model, uint surface);

}  // namespace trisect::bench
