#include "app/opengl/projection.h"

namespace trisect::opengl {

glm::dmat4 view_projection(const TraceParams& params) {
  const glm::dvec3 right = glm::dvec3(params.ray_dx) * (0.5 * params.width);
  const glm::dvec3 down = glm::dvec3(params.ray_dy) * (0.5 * params.height);
  const glm::dvec3 center = glm::dvec3(params.ray_corner) + right + down;
  // The far points are the near points times this ratio: w is 1 at z = -1 and 1 / ratio at z = 1.
  const double ratio = params.eye.w;
  const double w_middle = 0.5 * (1.0 + 1.0 / ratio);
  const double w_slope = 0.5 * (1.0 / ratio - 1.0);
  return glm::inverse(glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(-down, 0.0),
                                 glm::dvec4(0.0, 0.0, 0.0, w_slope), glm::dvec4(center, w_middle)));
}

}  // namespace trisect::opengl
