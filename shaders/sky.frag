#version 450
// The background of a rasterised frame: the sky.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"
#include "frame_buffers.glsl"
#include "rays.glsl"
#include "every_candidate.glsl"
#include "trace.glsl"
#include "fragment_outputs.glsl"

void main() {
  vec4 color;
  PixelAovs aovs;
  shade_pixel(pixel_ray(fragment_pixel(0u)), begin_traversal(0).hit, color, aovs);
  write_fragment(color, aovs);
}
