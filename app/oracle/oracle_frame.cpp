#include "app/oracle.h"
#include "app/parallel_rows.h"

namespace trisect {

OracleFrame oracle_frame(const Oracle& oracle, uint32_t width, uint32_t height,
                         const std::function<OracleRay(uint32_t x, uint32_t y)>& ray_of,
                         const std::function<double(const OracleRay&)>& motion_of,
                         const std::function<void(uint32_t)>& progress) {
  OracleFrame frame{width, height, {}};
  frame.pixels.resize(std::size_t{width} * height);
  const auto row = [&](uint32_t y) {
    for (uint32_t x = 0; x < width; ++x) {
      const OracleRay ray = ray_of(x, y);
      frame.pixels[std::size_t{y} * width + x] = oracle.first(ray, motion_of(ray));
    }
  };
  parallel_rows(height, row, progress);
  return frame;
}

}  // namespace trisect
