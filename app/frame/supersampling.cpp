#include "app/frame/supersampling.h"

#include <cmath>

#include "app/base/srgb.h"

namespace trisect {
namespace {

vec4 linear(const vec4& color) {
  return {linear_from_srgb(color.x), linear_from_srgb(color.y), linear_from_srgb(color.z), color.w};
}

vec4 encoded(const vec4& color) {
  return {srgb_from_linear(color.x), srgb_from_linear(color.y), srgb_from_linear(color.z), color.w};
}

}  // namespace

uint32_t samples_across(uint32_t spp) {
  return static_cast<uint32_t>(std::lround(std::sqrt(static_cast<double>(spp))));
}

Frame averaged(Frame samples, uint32_t across) {
  if (across == 1) return samples;
  const uint32_t width = samples.width / across;
  const uint32_t height = samples.height / across;
  const float weight = 1.0F / (static_cast<float>(across) * static_cast<float>(across));
  // In place: no pixel lies behind the first sample of its own, or of one that comes later.
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const auto sample = [&](uint32_t row, uint32_t column) {
        return (std::size_t{y} * across + row) * samples.width + std::size_t{x} * across + column;
      };
      vec4 sum(0.0F);
      uint evaluations = 0;
      uint candidates = 0;
      for (uint32_t row = 0; row < across; ++row) {
        for (uint32_t column = 0; column < across; ++column) {
          const std::size_t one = sample(row, column);
          sum += linear(samples.colors[one]);
          if (samples.aovs.empty()) continue;
          evaluations += samples.aovs[one].evaluations;
          candidates += samples.aovs[one].candidates;
        }
      }
      const std::size_t pixel = std::size_t{y} * width + x;
      samples.colors[pixel] = encoded(sum * weight);
      if (samples.aovs.empty()) continue;
      samples.aovs[pixel] = samples.aovs[sample(across / 2, across / 2)];
      samples.aovs[pixel].evaluations = evaluations;
      samples.aovs[pixel].candidates = candidates;
    }
  }
  samples.width = width;
  samples.height = height;
  samples.colors.resize(std::size_t{width} * height);
  if (!samples.aovs.empty()) samples.aovs.resize(samples.colors.size());
  return samples;
}

}  // namespace trisect
