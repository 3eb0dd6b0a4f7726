// A pinhole camera and the rays it gives the kernels.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "app/surface/shared.h"

namespace trisect {

struct Camera {
  glm::dvec3 eye{0.0, 0.0, 1.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double fov = 45.0;  // vertical, degrees, more than 0 and less than 180
};

// A camera that looks at `center` from in front, a little to the right and above, from where the
// model's vertices just leave a margin on every side of an image of this aspect (width over
// height). fov in degrees.
Camera framing_camera(std::span<const glm::dvec3> vertices, const glm::dvec3& center, double fov,
                      const glm::dvec3& up, double aspect);

// The unit direction in which the camera sees a position in an image of that size, in pixels, y
// down, (0, 0) the top left corner.
glm::dvec3 view_direction(const Camera& camera, uint32_t width, uint32_t height, double x,
                          double y);

// Fills in the members of `params` that describe a camera's rays, for an image of
// params.image_width x params.image_height pixels. origin, radius: of the scene, in world units;
// the rays are relative to the origin. near, far: distances of the two planes from the eye.
// Unprojects the corners of the clip volume by the double-precision inverse of the view-projection
// matrix, as the thesis does; through them every pixel's near point is linear in its position.
// Throws UsageError if the camera's target is its eye, or if it looks along its up vector.
void set_rays(const Camera& camera, const glm::dvec3& origin, double radius, double near,
              double far, TraceParams& params);

}  // namespace trisect
