#version 450
// Traces a frame without an acceleration structure: every ray tests the bounding balls of all subpatches (robust solver)
// or triangles (bisection). Vulkan and OpenGL both use this kernel.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

#include "frame_buffers.glsl"
#include "rays.glsl"
#include "every_candidate.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "trace_main.glsl"
