#version 450
// The renderer over the tree of the parts' boxes: every pixel against the parts in whose boxes its ray comes.
#extension GL_GOOGLE_include_directive : require
#define TRISECT_BVH
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

#include "frame_buffers.glsl"
#include "rays.glsl"
#include "bvh_candidates.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "trace_main.glsl"
