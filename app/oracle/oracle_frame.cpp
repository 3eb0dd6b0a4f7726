#include <fmt/format.h>

#include "app/base/memory.h"
#include "app/base/parallel_rows.h"
#include "app/oracle/oracle.h"

namespace trisect {

std::optional<OracleFrame> oracle_frame(
    const Oracle& oracle, uint32_t width, uint32_t height,
    const std::function<OracleRay(uint32_t x, uint32_t y)>& ray_of,
    const std::function<double(const OracleRay&)>& motion_of, const Progress& progress) {
  OracleFrame frame{width, height, {}};
  const std::size_t pixels = std::size_t{width} * height;
  expect_memory(static_cast<double>(pixels) * sizeof(frame.pixels.front()),
                fmt::format("the oracle's image of {}x{} pixels", width, height));
  frame.pixels.resize(pixels);
  const auto row = [&](uint32_t y, const Stopped& stopped) {
    for (uint32_t x = 0; x < width && !stopped; ++x) {
      const OracleRay ray = ray_of(x, y);
      frame.pixels[std::size_t{y} * width + x] = oracle.first(ray, motion_of(ray));
    }
  };
  if (!parallel_rows(height, row, progress)) return std::nullopt;
  return frame;
}

}  // namespace trisect
