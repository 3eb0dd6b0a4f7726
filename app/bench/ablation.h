// What each step from the thesis's way to this program's is worth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/bench/comparison.h"
#include "app/bench/options.h"
#include "vk/device.h"

namespace trisect::bench {

// A way to make a frame that differs in one thing from another one.
struct Step {
  std::string change;    // what that is
  std::size_t from = 0;  // index of the other one; its own, if there is none
  Measurement measurement;
};

struct Ablation {
  std::string model;  // its short name
  uint surface = SURFACE_PHONG;
  std::size_t patches = 0;
  std::size_t pixels = 0;
  std::vector<Step> steps;
};

// Measures all steps in turns. Throws what Vulkan's devices throw.
Ablation measure_ablation(const gpu::Device& device, const AblationOptions& options,
                          const std::string& model, uint surface);

}  // namespace trisect::bench
