#include "app/bench/sample_check.h"

#include <glm/glm.hpp>

#include "app/cli/interrupt.h"
#include "app/oracle/oracle_tracer.h"

namespace trisect::bench {

SampleCheck::SampleCheck(const BakedScene& scene, const TraceParams& params, uint32_t step,
                         const Progress& progress) {
  const Oracle oracle(scene);
  const double motion = kMotion * static_cast<double>(params.anchor.w);
  const uint32_t columns = (params.width + step - 1) / step;
  const uint32_t rows = (params.height + step - 1) / step;
  const OracleFrame grid = finished(oracle_frame(
      oracle, columns, rows,
      [&](uint32_t x, uint32_t y) { return oracle_pixel_ray(params, x * step, y * step).ray; },
      [&](const OracleRay&) { return motion; }, progress));
  OracleFrame answers{params.width, params.height, {}};
  answers.pixels.resize(std::size_t{params.width} * params.height);
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      const OracleAnswer& answer = grid.pixels[std::size_t{y} * columns + x];
      const std::size_t pixel = std::size_t{y} * step * params.width + std::size_t{x} * step;
      answers.pixels[pixel] = answer;
      if (answer.decidable) pixels_.push_back(pixel);
    }
  }
  truth_ = frame_of(answers, scene, params);
}

std::size_t SampleCheck::count_wrong(const Frame& frame) const {
  std::size_t wrong = 0;
  for (const std::size_t pixel : pixels_) {
    const vec4 apart = glm::abs(frame.colors[pixel] - truth_.colors[pixel]);
    const bool near = apart.w < 0.5F && apart.x <= 2.0F / 255.0F && apart.y <= 2.0F / 255.0F &&
                      apart.z <= 2.0F / 255.0F;
    // A NaN is wrong.
    if (!near) ++wrong;
  }
  return wrong;
}

}  // namespace trisect::bench
