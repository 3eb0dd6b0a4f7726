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

#include "rays.glsl"
#include "every_candidate.glsl"
#include "trace.glsl"
#include "queue.glsl"
#include "fragment_outputs.glsl"

// The path of a pixel that does not wait.
const uint NOWHERE = 0u;

void main() {
  // first_group is the band's lowest row.
  uvec2 pixel = fragment_pixel(push.first_group);
  uint index = (pixel.y - push.first_row) * params.width + pixel.x;
  precise Traversal traversal = begin_traversal(int(push.queue.steps));
  if (push.queue.pass > 0u) {
    if (paused[index].path == NOWHERE) discard;
    traversal = resumed_traversal(index, traversal.steps);
  }
  precise PixelRay ray = ray_through(to_near, across);
  resume(ray, push.queue.pass, traversal);
  count_bytes(traversal);
  if (!is_finished(ray, traversal)) {
    pause(index, index, traversal);
    atomicAdd(state.queued, 1u);
    discard;
  }
  if (push.queue.pass > 0u) paused[index].path = NOWHERE;
  precise vec4 color;
  precise PixelAovs aovs;
  finish_pixel(ray, traversal, color, aovs);
  write_fragment(color, aovs);
}
