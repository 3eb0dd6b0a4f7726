// Where in space a frame's hits are.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "app/dispatch/camera.h"
#include "app/frame/frame.h"
#include "app/frame/image_part.h"

namespace trisect {

// The place of the hit of the pixel (x, y) in the model's units: the eye plus Z times the direction
// of the pixel's ray, both in double precision; 0 where nothing was hit. across: rays in a row of a
// pixel, of which averaged() keeps the middle one's Z. place: of the frame in the camera's image.
// The frame must have AOVs.
glm::vec3 hit_position(const Frame& frame, uint32_t x, uint32_t y, const Camera& camera,
                       uint32_t across, const FramePlace& place);

}  // namespace trisect
