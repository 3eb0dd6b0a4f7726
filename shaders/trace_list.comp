#version 450
// The renderer as a compute kernel: every pixel against every triangle of the storage buffer.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

#include "frame_buffers.glsl"
layout(std430, binding = BINDING_COLOR) writeonly restrict buffer ColorBlock { vec4 colors[]; };
layout(std430, binding = BINDING_AOVS) writeonly restrict buffer AovsBlock { PixelAovs pixels[]; };

#include "every_part.glsl"
#include "trace.glsl"
#include "queue.glsl"
#include "trace_walks.glsl"
