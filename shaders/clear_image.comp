#version 450
// Clears the image and does nothing else: measurements take its time as that of a frame without any tracing.
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

layout(std140, binding = BINDING_PARAMS) uniform ParamsBlock { TraceParams params; };
layout(std430, binding = BINDING_COLOR) writeonly restrict buffer ColorBlock { vec4 colors[]; };

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x < params.width && pixel.y < params.height) colors[pixel.y * params.width + pixel.x] = vec4(0.0);
}
