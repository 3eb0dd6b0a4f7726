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
void meet(uint subpatch, PixelRay ray, bool here, inout Traversal traversal, inout bool undecided) {
  precise SubpatchBounds bounds;
  precise Triangle tri;
  load_by_all(subpatch, bounds, tri);
  precise FramedPatch framed = sheared_patch(ray.frame, rotated_patch(ray.frame, SHELL, tri));
  float tolerance = position_tolerance(ray.frame, tri);
  ControlNet net = control_net(framed, bounds.corner.xyz, bounds.edge.xyz, with_overlap(sub_triangle_at(bounds.sub_triangle, WHOLE)));
  here = here && hull_overlaps_ray(net, ray.frame.stretch * bounds.corner.w + tolerance);
  intersect_quickly(tri, bounds.triangle, bounds, framed, subpatch, ray, tolerance, here, traversal, undecided);
}

void main() {
  uint tile = push.first_group + gl_WorkGroupID.x;
  uint columns = tiles_across(params.width);
  uvec2 pixel = uvec2(tile % columns, tile / columns) * TILE_SIZE + pixel_in_tile(gl_LocalInvocationIndex);
  precise PixelRay ray = ray_of(pixel);
  precise Traversal traversal = begin_pixel_traversal(pixel, 0);
  Packet packet = packet_of(ray, traversal.hit.z != TRAVERSAL_ENDED);
  bool undecided = false;
  Descent descent = descent_begun(packet);
  bool here;
  uint subpatch;
  do {
    subpatch = next_part(packet, ray, traversal.hit.z, descent, here);
    if (subpatch != NO_TRIANGLE) meet(subpatch, ray, here, traversal, undecided);
    end_in_shadow(traversal);
  } while (subpatch != NO_TRIANGLE);
  undecided = (undecided || descent.steps <= 0) && traversal.hit.z != TRAVERSAL_ENDED;
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  traversal.counts.bytes = descent.bytes;
  count_bytes(traversal);
  if (undecided) {
    enqueue(pixel.y * params.width + pixel.x, traversal);
    return;
  }
  write_pixel(pixel, ray, traversal);
}
