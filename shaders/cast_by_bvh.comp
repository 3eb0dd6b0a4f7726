#version 450
// Rays from a buffer, whatever they are aimed at, against those whose boxes a tree finds.
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
