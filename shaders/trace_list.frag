#version 450
// Traces a frame as the thesis does, for OpenGL: the fragments of a full-screen quad are the pixels. Every pixel has a
// place of its own in the queue; the quad is drawn again until no pixel is paused.
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

// PausedRay::path of a pixel that is not paused.
const uint NOT_PAUSED = 0u;

void main() {
  // OpenGL draws without workgroups: first_group is the band's lowest row, counted from the bottom of the image.
  uvec2 pixel = fragment_pixel(push.first_group);
  uint index = (pixel.y - push.first_row) * params.width + pixel.x;
  precise Traversal traversal = begin_traversal(int(state.now.steps));
  if (state.now.pass > 0u) {
    if (paused[index].path == NOT_PAUSED) discard;
    traversal = resumed_traversal(index, traversal.steps);
  }
  precise PixelRay ray = ray_through(to_near, across);
  resume(ray, state.now.pass, traversal);
  count_bytes(traversal);
  if (!is_finished(ray, traversal)) {
    pause(index, index, traversal);
    atomicAdd(state.queued, 1u);
    discard;
  }
  if (state.now.pass > 0u) paused[index].path = NOT_PAUSED;
  precise vec4 color;
  precise PixelAovs aovs;
  finish_pixel(ray, traversal, color, aovs);
  write_fragment(color, aovs);
}
