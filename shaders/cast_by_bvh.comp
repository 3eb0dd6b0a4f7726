#version 450
// Casts rays from a buffer, of any origin and direction. Their candidates are found by the scene's BVH.
#extension GL_GOOGLE_include_directive : require
#define TRISECT_BVH
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = CAST_SIZE) in;

#include "cast_buffers.glsl"
#include "rays.glsl"
#include "bvh_candidates.glsl"
#include "trace.glsl"
#include "queue.glsl"
#include "cast_main.glsl"
