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
  Frame frame;
  frame.resize(samples.width / across, samples.height / across, !samples.aovs.empty());
  frame.bytes_read = samples.bytes_read;
  frame.queued_rays = samples.queued_rays;
  const float weight = 1.0F / (static_cast<float>(across) * static_cast<float>(across));
  for (uint32_t y = 0; y < frame.height; ++y) {
    for (uint32_t x = 0; x < frame.width; ++x) {
      const std::size_t pixel = std::size_t{y} * frame.width + x;
      const auto sample = [&](uint32_t row, uint32_t column) {
        return (std::size_t{y} * across + row) * samples.width + std::size_t{x} * across + column;
      };
      if (!frame.aovs.empty()) {
        frame.aovs[pixel] = samples.aovs[sample(across / 2, across / 2)];
        frame.aovs[pixel].evaluations = 0;
        frame.aovs[pixel].candidates = 0;
      }
      vec4 sum(0.0F);
      for (uint32_t row = 0; row < across; ++row) {
        for (uint32_t column = 0; column < across; ++column) {
          const std::size_t one = sample(row, column);
          sum += linear(samples.colors[one]);
          if (frame.aovs.empty()) continue;
          frame.aovs[pixel].evaluations += samples.aovs[one].evaluations;
          frame.aovs[pixel].candidates += samples.aovs[one].candidates;
        }
      }
      frame.colors[pixel] = encoded(sum * weight);
    }
  }
  return frame;
}

}  // namespace trisect
