// Measures the effect of each step from the thesis's tracer to this program's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/bench/comparison.h"
#include "app/bench/options.h"
#include "vk/device.h"

namespace trisect::bench {

// A tracer that differs from that of another step in one choice.
struct Step {
  std::string change;    // that choice
  std::size_t from = 0;  // index of the other step; its own index if there is none
  Measurement measurement;
};

struct Ablation {
  std::string model;  // its short name
  uint surface = SURFACE_PHONG;
  std::size_t patches = 0;
  std::size_t pixels = 0;
  std::vector<Step> steps;
};

// Measures all steps in turns. Throws InputError and DeviceError.
Ablation measure_ablation(const gpu::Device& device, const AblationOptions& options,
                          const std::string& model, uint surface);

}  // namespace trisect::bench
