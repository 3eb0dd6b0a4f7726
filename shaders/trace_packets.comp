#version 450
// The renderer over the tree of the parts' boxes for packets of rays: a subgroup goes down it together, as long as one
// of its rays may meet what is there. What Newton's method does not decide at once is left to trace_bvh.comp: no ray
// waits here for a difficult neighbour.
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
#include "bvh_candidates.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "intersect_quickly.glsl"
#include "packets.glsl"

// One part, all rays of the subgroup.
void meet(uint part, PixelRay ray, bool here, inout Walk walk, inout bool undecided) {
  precise Cage cage;
  precise Triangle tri;
  load_by_all(part, cage, tri);
  precise FramedPatch framed = sheared_patch(ray.frame, turned_patch(ray.frame, SHELL, tri));
  float reach = grain(ray.frame, tri);
  Net net = cage_net(framed, cage.corner.xyz, cage.edge.xyz, widened(node_at(cage.node, WHOLE)));
  here = here && near_ray(net, ray.frame.stretch * cage.corner.w + reach);
  meet_quickly(tri, cage.triangle, cage, framed, part, ray, reach, here, walk, undecided);
}

void main() {
  uint tile = push.first_group + gl_WorkGroupID.x;
  uint columns = tiles_across(params.width);
  uvec2 pixel = uvec2(tile % columns, tile / columns) * TILE_SIZE + pixel_in_tile(gl_LocalInvocationIndex);
  precise PixelRay ray = ray_of(pixel);
  precise Walk walk = walk_of(pixel, 0);
  Packet packet = packet_of(ray, walk.hit.z != NOTHING_MORE);
  bool undecided = false;
  Descent descent = descent_begun(packet);
  bool here;
  uint part;
  do {
    part = next_part(packet, ray, walk.hit.z, descent, here);
    if (part != NO_TRIANGLE) meet(part, ray, here, walk, undecided);
    end_in_shadow(walk);
  } while (part != NO_TRIANGLE);
  undecided = (undecided || descent.steps <= 0) && walk.hit.z != NOTHING_MORE;
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  walk.counts.bytes = descent.bytes;
  count_bytes(walk);
  if (undecided) {
    enqueue(pixel.y * params.width + pixel.x, walk);
    return;
  }
  write_pixel(pixel, ray, walk);
}
