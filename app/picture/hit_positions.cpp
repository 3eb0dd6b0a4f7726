#include "app/picture/hit_positions.h"

#include <cmath>
#include <cstddef>

namespace trisect {

std::vector<glm::vec3> hit_positions(const Frame& frame, const Camera& camera, uint32_t across,
                                     const FramePlace& place) {
  const double middle = (std::floor(across / 2.0) + 0.5) / across;
  std::vector<glm::vec3> positions;
  positions.reserve(frame.aovs.size());
  for (uint32_t y = 0; y < frame.height; ++y) {
    for (uint32_t x = 0; x < frame.width; ++x) {
      const PixelAovs& pixel = frame.aovs[positions.size()];
      const glm::dvec3 ray = view_direction(camera, place.image_width, place.image_height,
                                            place.x + x + middle, place.y + y + middle);
      positions.emplace_back(pixel.triangle == NO_TRIANGLE
                                 ? glm::dvec3(0.0)
                                 : camera.eye + ray * static_cast<double>(pixel.normal_z.w));
    }
  }
  return positions;
}

}  // namespace trisect
