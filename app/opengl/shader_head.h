// What the shaders of shaders/ expect ahead of their text, as OpenGL has no specialisation
// constants.
#pragma once

#include <string>

#include "app/bake/bake.h"
#include "app/buffers/kernel_choice.h"

namespace trisect::opengl {

// The version, and the values of frame_buffers.glsl's constants. shadows: of the rays for them.
std::string shader_head(const BakedScene& scene, const KernelChoice& choice, bool shadows);

}  // namespace trisect::opengl
