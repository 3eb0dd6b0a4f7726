#version 450
// Traces a frame by the scene's BVH for packets of rays: the rays of a subgroup traverse it together, into every box that
// one of them may meet. Rays that Newton's method leaves undecided are queued for trace_pending.comp, so that the other rays
// of their packet do not wait for them here.
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

#include "workgroup_order.glsl"
#include "rays.glsl"
#include "bvh_candidates.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "pending.glsl"
#include "intersect_quickly.glsl"
#include "broadcast.glsl"
#include "broadcast_triangle.glsl"
#include "packets.glsl"

void main() {
  uvec2 pixel = pixel_of_tile(GROUP_IN_TURN, gl_LocalInvocationIndex);
  precise PixelRay ray = ray_of(pixel);
  precise Traversal traversal = begin_pixel_traversal(pixel, 0);
  Packet packet = packet_of(ray, traversal.hit.z != TRAVERSAL_ENDED);
  Pending pending = nothing_pending();
  PacketTraversal packet_traversal = begin_packet_traversal(packet);
  bool near;
  uint subpatch;
  do {
    subpatch = next_packet_candidate(packet, ray, traversal.hit.z, packet_traversal, near);
    if (subpatch != NO_TRIANGLE) {
      precise SubpatchBounds bounds;
      precise Triangle tri;
      load_uniform(subpatch, bounds, tri);
      intersect_patch_quickly(tri, bounds, subpatch, ray, near, traversal, pending);
    }
    end_in_shadow(traversal);
  } while (subpatch != NO_TRIANGLE);
  if (packet_traversal.steps <= 0) pending.count = TOO_MANY_PENDING;
  bool undecided = pending.count > 0u && traversal.hit.z != TRAVERSAL_ENDED;
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  traversal.counts.bytes = packet_traversal.bytes;
  count_bytes(traversal);
  if (undecided) {
    enqueue_pending(pixel.y * params.width + pixel.x, traversal, pending);
    return;
  }
  write_pixel(pixel, ray, traversal);
}
