#version 450
// Traces a frame. A ray's candidates are the subpatches whose bounding boxes it meets, found by the scene's BVH; each ray
// traverses it by itself.
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
