#version 460
// The renderer over the device's own acceleration structure (VK_KHR_ray_query): it finds the boxes in which a ray comes, in
// any order, and the solver looks at the parts in them. A ray that takes too many steps for that starts anew in
// trace_bvh.comp.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#define TRISECT_BVH
#define TRISECT_ADDRESSES
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

// Goes through all boxes. Returns false if the steps did not last.
bool walk_query(PixelRay ray, inout Walk walk) {
  // From where the ray comes into the scene's ball, about which positions count: however far away it began, its first
  // point has the digits of the scene.
  float middle = -dot(ray.anchor, ray.view);
  float begin = max(ray.frame.stretch * ray.nearest, middle - addresses.reach);
  float end = min(ray.frame.stretch * walk.hit.z, middle + addresses.reach);
  if (!(begin < end)) return true;
  // What boxes of hits so near may still hold a hit at the same place.
  float slack = BVH_SLACK * (addresses.reach + length(ray.anchor));
  float limit = end - begin + slack;
  rayQueryEXT query;
  rayQueryInitializeEXT(query, accelerationStructureEXT(uvec2(addresses.boxes_low, addresses.boxes_high)),
                        gl_RayFlagsNoneEXT, 0xFFu, ray.anchor + ray.view * begin, 0.0, ray.view, limit);
  while (rayQueryProceedEXT(query)) {
    uint part = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
    if (GROUPS && cages[part].skip > 0u) continue;
    if (COUNTS) {
      ++walk.counts.candidates;
      walk.counts.bytes += TRIANGLE_BYTES + CAGE_BYTES;
    }
    precise Cage cage = cages[part];
    precise Triangle tri = triangles[cage.triangle];
    meet_part(scene_shape(), KINKS, tri, cage, part, ray.frame, ray.view, ray.nearest, walk);
    end_in_shadow(walk);
    walk.steps -= VISIT_STEPS;
    if (walk.path != WHOLE || walk.steps <= 0) {
      rayQueryTerminateEXT(query);
      return false;
    }
    if (walk.hit.z == NOTHING_MORE) {
      rayQueryTerminateEXT(query);
      return true;
    }
    float now = ray.frame.stretch * walk.hit.z - begin + slack;
    if (now < limit) {
      limit = max(now, 0.0);
      rayQueryGenerateIntersectionEXT(query, limit);
    }
  }
  return true;
}

void main() {
  uint tile = push.first_group + gl_WorkGroupID.x;
  uint columns = tiles_across(params.width);
  uvec2 pixel = uvec2(tile % columns, tile / columns) * TILE_SIZE + pixel_in_tile(gl_LocalInvocationIndex);
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  precise PixelRay ray = ray_of(pixel);
  precise Walk walk = walk_of(pixel, int(push.queue.steps));
  bool through = walk.hit.z == NOTHING_MORE || walk_query(ray, walk);
  count_bytes(walk);
  if (!through) {
    walk.path = WHOLE;
    enqueue(pixel.y * params.width + pixel.x, walk);
    return;
  }
  write_pixel(pixel, ray, walk);
}
