// The camera as a matrix for OpenGL.
#pragma once

#include <glm/glm.hpp>

#include "app/surface/shared.h"

namespace trisect::opengl {

// The view-projection matrix for points relative to the eye, derived from the rays of `params`: its
// inverse maps the near face of the clip volume to the near points of the image.
glm::dmat4 view_projection(const TraceParams& params);

}  // namespace trisect::opengl
