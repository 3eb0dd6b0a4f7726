#version 450
// Searches the subpatches that Newton's method left undecided for rays of trace_tiles.comp or trace_packets.comp. Rays for
// which there were too many, or whose steps run out, are queued for a kernel that goes through all their candidates again.
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

void main() {
  uint invocation = gl_WorkGroupID.x * TILE_SIZE * TILE_SIZE + gl_LocalInvocationIndex;
  if (invocation >= state.now.resumed) return;
  uint place = state.now.from + invocation;
  precise Traversal traversal = resumed_traversal(place, int(state.now.steps));
  uint index = paused[place].ray;
  uvec2 pixel = uvec2(index % params.width, index / params.width);
  precise PixelRay ray = ray_of(pixel);
  uint left = paused[place].pending_count;
  // There were too many, or its steps have run out.
  bool starts_over = left == 0u;
  while (left > 0u && !starts_over) {
    uint subpatch = paused[place].pending[left - 1u];
    precise SubpatchBounds bounds = subpatches[subpatch];
    precise Triangle tri = triangles[bounds.triangle];
    if (COUNTS) traversal.counts.bytes += TRIANGLE_BYTES + SUBPATCH_BYTES;
    if (!misses_ball(ray, bounds.ball, traversal.hit.z)) {
      precise FramedPatch framed = sheared_patch(ray.frame, rotated_patch(ray.frame, SHELL, tri));
      search_subpatch(scene_shape(), MAY_BE_NONSMOOTH, tri, bounds, subpatch, ray.frame, framed,
                      position_tolerance(ray.frame, tri), ray.nearest, traversal);
      end_in_shadow(traversal);
    }
    traversal.steps -= VISIT_STEPS;
    --left;
    starts_over = traversal.path != WHOLE || (left > 0u && traversal.steps <= 0);
  }
  count_bytes(traversal);
  if (starts_over) {
    traversal.item = 0u;
    traversal.path = WHOLE;
    enqueue(index, traversal);
    return;
  }
  write_pixel(pixel, ray, traversal);
}
