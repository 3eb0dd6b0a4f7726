// The camera as OpenGL's clip volume.
#pragma once

#include <glm/glm.hpp>

#include "app/surface/shared.h"

namespace trisect::opengl {

// View and projection of points relative to the eye, from the rays that the other kernels have: its
// inverse takes the clip volume's near face to the image's near points.
glm::dmat4 view_projection(const TraceParams& params);

}  // namespace trisect::opengl
