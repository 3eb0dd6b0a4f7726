// What goes ahead of a shader's text for OpenGL, whose GLSL has no specialisation constants.
#pragma once

#include <string>

#include "app/bake/bake.h"
#include "app/buffers/kernel_choice.h"

namespace trisect::opengl {

// #version, and definitions of the values of the constants in shaders/frame_buffers.glsl. shadows:
// whether the shader traces shadow rays instead of camera rays.
std::string shader_head(const BakedScene& scene, const KernelChoice& choice, bool shadows);

}  // namespace trisect::opengl
