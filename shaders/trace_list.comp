#version 450
// The renderer as a compute kernel: every pixel against every triangle of the storage buffer.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

#include "frame_buffers.glsl"
layout(std430, binding = BINDING_COLOR) writeonly restrict buffer ColorBlock { vec4 colors[]; };
layout(std430, binding = BINDING_AOVS) writeonly restrict buffer AovsBlock { PixelAovs pixels[]; };

#include "trace.glsl"
#include "queue.glsl"

// The pixel of an invocation that begins one; outside of the image, if the image ends before its workgroup does.
uvec2 new_pixel() {
  uint groups_x = (params.width + TILE_SIZE - 1u) / TILE_SIZE;
  uint group = push.first_group + gl_WorkGroupID.x;
  return uvec2(group % groups_x, group / groups_x) * TILE_SIZE + gl_LocalInvocationID.xy;
}

void main() {
  precise Walk walk = walk_begun(int(push.queue.steps));
  uvec2 pixel;
  if (push.queue.pass == 0u) {
    pixel = new_pixel();
    if (pixel.x >= params.width || pixel.y >= params.height) return;
  } else {
    uint invocation = gl_WorkGroupID.x * TILE_SIZE * TILE_SIZE + gl_LocalInvocationIndex;
    if (invocation >= push.queue.resumed) return;
    uint place = push.queue.from + invocation;
    walk = resumed_walk(place, walk.steps);
    uint index = paused[place].ray;
    pixel = uvec2(index % params.width, index / params.width);
  }
  precise PixelRay ray = pixel_ray(pixel);
  go_on(ray, push.queue.pass, walk);
  if (!is_through(walk)) {
    pause(push.queue.to + atomicAdd(queued, 1u), pixel.y * params.width + pixel.x, walk);
    return;
  }
  precise vec4 color;
  precise PixelAovs aovs;
  finish_pixel(ray, walk, color, aovs);
  uint index = (pixel.y - push.first_row) * params.width + pixel.x;
  colors[index] = color;
  if (AOVS) pixels[index] = aovs;
}
