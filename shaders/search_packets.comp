#version 450
// Pixels that trace_packets.comp left undecided, in packets again. A ray that takes too many steps for that starts anew
// in trace_bvh.comp.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_vote : require
#define TRISECT_BVH
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE * TILE_SIZE) in;

#include "frame_buffers.glsl"
#include "rays.glsl"
#include "bvh_parts.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "packets.glsl"

void main() {
  uint invocation = gl_WorkGroupID.x * TILE_SIZE * TILE_SIZE + gl_LocalInvocationIndex;
  // What is too much goes with the last ray and does nothing.
  bool awake = invocation < push.queue.resumed;
  uint place = push.queue.from + min(invocation, push.queue.resumed - 1u);
  precise Walk walk = resumed_walk(place, int(push.queue.steps));
  uint index = paused[place].ray;
  uvec2 pixel = uvec2(index % params.width, index / params.width);
  precise PixelRay ray = ray_of(pixel);
  Packet packet = packet_of(ray, true);
  Descent descent = descent_begun(packet);
  bool here;
  uint part;
  do {
    awake = awake && walk.path == WHOLE && walk.steps > 0;
    part = next_part(packet, ray, awake, walk.hit.z, descent, here);
    if (part != NO_TRIANGLE) {
      precise Cage cage;
      precise Triangle tri;
      load_by_all(part, cage, tri);
      if (here) {
        if (COUNTS) ++walk.counts.candidates;
        meet_part(scene_shape(), KINKS, tri, cage, part, ray.frame, ray.view, ray.nearest, walk);
        end_in_shadow(walk);
        walk.steps -= VISIT_STEPS;
      }
    }
  } while (part != NO_TRIANGLE);
  if (invocation >= push.queue.resumed) return;
  walk.counts.bytes = descent.bytes;
  count_bytes(walk);
  if (!awake || walk.path != WHOLE || descent.steps <= 0) {
    walk.path = WHOLE;
    enqueue(index, walk);
    return;
  }
  write_pixel(pixel, ray, walk);
}
