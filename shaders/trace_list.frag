#version 450
// The renderer as the thesis has it, for OpenGL: a full-screen quad whose fragments are the pixels. A pixel that
// pauses waits at its own place of the queue, for the quad to be drawn again.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"
#include "frame_buffers.glsl"

in vec3 to_near;
in vec2 across;
layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_normal_z;
layout(location = 2) out vec4 out_geometric_u;
layout(location = 3) out uvec4 out_rest;  // v's bits, triangle, evaluations, candidates

#include "rays.glsl"
#include "every_part.glsl"
#include "trace.glsl"
#include "queue.glsl"

// The path of a pixel that does not wait.
const uint NOWHERE = 0u;

void main() {
  // OpenGL counts rows from below; first_group is the band's lowest row.
  uvec2 pixel = uvec2(uint(gl_FragCoord.x), params.height - 1u - push.first_group - uint(gl_FragCoord.y));
  uint index = (pixel.y - push.first_row) * params.width + pixel.x;
  precise Walk walk = walk_begun(int(push.queue.steps));
  if (push.queue.pass > 0u) {
    if (paused[index].path == NOWHERE) discard;
    walk = resumed_walk(index, walk.steps);
  }
  precise PixelRay ray = ray_through(to_near, across);
  go_on(ray, push.queue.pass, walk);
  if (!is_through(ray, walk)) {
    pause(index, index, walk);
    atomicAdd(queued, 1u);
    discard;
  }
  if (push.queue.pass > 0u) paused[index].path = NOWHERE;
  precise vec4 color;
  precise PixelAovs aovs;
  finish_pixel(ray, walk, color, aovs);
  out_color = color;
  if (AOVS) {
    out_normal_z = aovs.normal_z;
    out_geometric_u = aovs.geometric_u;
    out_rest = uvec4(floatBitsToUint(aovs.v), aovs.triangle, aovs.evaluations, aovs.candidates);
  }
}
