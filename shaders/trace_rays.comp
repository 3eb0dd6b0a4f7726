#version 450
// Traces a frame by the scene's BVH, which each ray traverses by itself: for scenes with so many subpatches that the rays of
// a packet meet a different one each, and for devices whose subgroups are no packets (app/dispatch/accel.cpp). Rays that
// Newton's method leaves undecided are queued for trace_pending.comp.
#extension GL_GOOGLE_include_directive : require
#define TRISECT_BVH
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE * TILE_SIZE) in;

#include "frame_buffers.glsl"
#include "workgroup_order.glsl"
#include "rays.glsl"
#include "bvh_candidates.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "pending.glsl"
#include "intersect_quickly.glsl"
#include "stack_traversal.glsl"

void main() {
  uvec2 pixel = pixel_of_tile(GROUP_IN_TURN, gl_LocalInvocationIndex);
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  precise PixelRay ray = ray_of(pixel);
  precise Traversal traversal = begin_pixel_traversal(pixel, int(state.now.steps));
  Pending pending = nothing_pending();
  StackTraversal at = begin_stack_traversal(ray, ray.frame.stretch * traversal.hit.z, traversal);
  uint subpatch;
  do {
    subpatch = next_candidate(ray.frame.stretch * traversal.hit.z, at, traversal);
    if (subpatch != NO_TRIANGLE) {
      precise SubpatchBounds bounds = subpatches[subpatch];
      precise Triangle tri = triangles[bounds.triangle];
      if (COUNTS) traversal.counts.bytes += SUBPATCH_BYTES + TRIANGLE_BYTES;
      bool near = !misses_ball(ray, bounds.ball, traversal.hit.z);
      intersect_patch_quickly(tri, bounds, subpatch, ray, near, traversal, pending);
      end_in_shadow(traversal);
    }
  } while (subpatch != NO_TRIANGLE);
  if (at.has_given_up) pending.count = TOO_MANY_PENDING;
  // What is undecided does not matter in a shadow that is certain.
  bool undecided = pending.count > 0u && traversal.hit.z != TRAVERSAL_ENDED;
  count_bytes(traversal);
  if (undecided) {
    enqueue_pending(pixel.y * params.width + pixel.x, traversal, pending);
    return;
  }
  write_pixel(pixel, ray, traversal);
}
