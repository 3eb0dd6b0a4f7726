#version 450
// Pixels that trace_tiles.comp left undecided, against every part that their tile touches.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

#include "frame_buffers.glsl"
layout(std430, binding = BINDING_COLOR) writeonly restrict buffer ColorBlock { vec4 colors[]; };
layout(std430, binding = BINDING_AOVS) writeonly restrict buffer AovsBlock { PixelAovs pixels[]; };

#include "tile_parts.glsl"
#include "trace.glsl"
#include "queue.glsl"
#include "trace_walks.glsl"
