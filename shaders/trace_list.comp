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
layout(push_constant) uniform PushBlock { TilePush push; };

#include "trace.glsl"
#include "queue.glsl"

// The pixel of an invocation that begins one; outside of the image, if the image ends before its workgroup does.
uvec2 new_pixel() {
  uint groups_x = (params.width + TILE_SIZE - 1u) / TILE_SIZE;
  uint group = push.first_group + gl_WorkGroupID.x;
  return uvec2(group % groups_x, group / groups_x) * TILE_SIZE + gl_LocalInvocationID.xy;
}

void main() {
  Walk walk = walk_begun(int(push.queue.steps));
  uvec2 pixel;
  if (push.queue.pass == 0u) {
    pixel = new_pixel();
    if (pixel.x >= params.width || pixel.y >= params.height) return;
  } else {
    uint invocation = gl_WorkGroupID.x * TILE_SIZE * TILE_SIZE + gl_LocalInvocationIndex;
    if (invocation >= push.queue.resumed) return;
    uint index = resumed_ray(invocation, walk);
    pixel = uvec2(index % params.width, index / params.width);
  }
  PixelRay ray = pixel_ray(pixel);
  go_on(ray, push.queue.pass, walk);
  if (!is_through(walk)) {
    pause(pixel.y * params.width + pixel.x, walk);
    return;
  }
  vec4 color;
  PixelAovs aovs;
  finish_pixel(ray, walk, color, aovs);
  uint index = (pixel.y - push.first_row) * params.width + pixel.x;
  colors[index] = color;
  if (AOVS) pixels[index] = aovs;
}
