#version 450
// Casts rays from a buffer, of any origin and direction, each against the whole list of subpatches or triangles.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = CAST_SIZE) in;

#include "cast_buffers.glsl"
#include "rays.glsl"
#include "every_candidate.glsl"
#include "trace.glsl"
#include "queue.glsl"
#include "cast_main.glsl"
