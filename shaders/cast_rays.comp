#version 450
// Rays from a buffer, whatever they are aimed at, against every triangle.
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
