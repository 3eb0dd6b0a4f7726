#include "app/picture/hit_position.h"

#include <cmath>
#include <cstddef>

namespace trisect {

glm::vec3 hit_position(const Frame& frame, uint32_t x, uint32_t y, const Camera& camera,
                       uint32_t across, const FramePlace& place) {
  const PixelAovs& pixel = frame.aovs[std::size_t{y} * frame.width + x];
  if (pixel.triangle == NO_TRIANGLE) return glm::vec3(0.0F);
  const double middle = (std::floor(across / 2.0) + 0.5) / across;
  const glm::dvec3 ray = view_direction(camera, place.image_width, place.image_height,
                                        place.x + x + middle, place.y + y + middle);
  return camera.eye + ray * static_cast<double>(pixel.normal_z.w);
}

}  // namespace trisect
