#version 450
// The renderer as a compute kernel: every pixel against every triangle of the storage buffer.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

layout(constant_id = CONSTANT_SURFACE) const uint SURFACE = SURFACE_PHONG;
layout(constant_id = CONSTANT_SHELL) const uint SHELL = SHELL_NORMAL;
layout(constant_id = CONSTANT_GROUPS) const bool GROUPS = false;
layout(constant_id = CONSTANT_SOLVER) const uint SOLVER = SOLVER_ROBUST;
layout(constant_id = CONSTANT_AOVS) const bool AOVS = false;
layout(constant_id = CONSTANT_COUNTS) const bool COUNTS = false;

layout(std140, binding = BINDING_PARAMS) uniform ParamsBlock { TraceParams params; };
layout(std430, binding = BINDING_TRIANGLES) readonly restrict buffer TrianglesBlock {
  Triangle triangles[];
};
layout(std430, binding = BINDING_CAGES) readonly restrict buffer CagesBlock { Cage cages[]; };
layout(std430, binding = BINDING_COLOR) writeonly restrict buffer ColorBlock { vec4 colors[]; };
layout(std430, binding = BINDING_AOVS) writeonly restrict buffer AovsBlock { PixelAovs pixels[]; };
layout(push_constant) uniform PushBlock { TilePush tile; };

#include "trace.glsl"

void main() {
  uint groups_x = (params.width + TILE_SIZE - 1u) / TILE_SIZE;
  uint group = tile.first_group + gl_WorkGroupID.x;
  uvec2 pixel = uvec2(group % groups_x, group / groups_x) * TILE_SIZE + gl_LocalInvocationID.xy;
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  uint index = (pixel.y - tile.first_row) * params.width + pixel.x;
  vec4 color;
  PixelAovs aovs;
  trace_pixel(pixel, color, aovs);
  colors[index] = color;
  if (AOVS) pixels[index] = aovs;
}
