#version 450
// Traces the pixels of trace_tiles.comp that trace_pending.comp passes on, each by the whole list of its tile.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

#include "frame_buffers.glsl"
#include "rays.glsl"
#include "tile_candidates.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "trace_main.glsl"
