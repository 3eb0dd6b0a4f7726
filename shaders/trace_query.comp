#version 460
// Traces a frame by the device's own acceleration structure (VK_KHR_ray_query) over the subpatches' bounding boxes, which
// finds the boxes that a ray meets, in any order. A ray that takes more steps than a submit allows starts over in
// trace_bvh.comp, because a ray query cannot be resumed.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#define TRISECT_BVH
#define TRISECT_ADDRESSES
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

// Returns false if the steps were used up before the traversal was finished.
bool traverse_query(PixelRay ray, inout Traversal traversal) {
  // The query gets the section of the ray within the scene's ball. A point at its beginning is rounded relative to the
  // size of the scene, however far away the ray starts.
  float middle = -dot(ray.anchor, ray.view);
  float begin = max(ray.frame.stretch * ray.nearest, middle - addresses.scene_radius);
  float end = min(ray.frame.stretch * traversal.hit.z, middle + addresses.scene_radius);
  if (!(begin < end)) return true;
  // Boxes beyond the nearest hit by less than this rounding error may still hold a hit at the same depth.
  float slack = BVH_SLACK * (addresses.scene_radius + length3(ray.anchor));
  float limit = end - begin + slack;
  rayQueryEXT query;
  rayQueryInitializeEXT(query, accelerationStructureEXT(uvec2(addresses.boxes_low, addresses.boxes_high)),
                        gl_RayFlagsNoneEXT, 0xFFu, ray.anchor + ray.view * begin, 0.0, ray.view, limit);
  while (rayQueryProceedEXT(query)) {
    uint subpatch = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
    if (DIVIDED && subpatches[subpatch].skip > 0u) continue;
    if (COUNTS) {
      ++traversal.counts.candidates;
      traversal.counts.bytes += TRIANGLE_BYTES + SUBPATCH_BYTES;
    }
    precise SubpatchBounds bounds = subpatches[subpatch];
    precise Triangle tri = triangles[bounds.triangle];
    intersect_subpatch(scene_shape(), MAY_BE_NONSMOOTH, tri, bounds, subpatch, ray.frame, ray.view, ray.nearest, traversal);
    end_in_shadow(traversal);
    traversal.steps -= VISIT_STEPS;
    if (traversal.path != WHOLE || traversal.steps <= 0) {
      rayQueryTerminateEXT(query);
      return false;
    }
    if (traversal.hit.z == TRAVERSAL_ENDED) {
      rayQueryTerminateEXT(query);
      return true;
    }
    float new_limit = ray.frame.stretch * traversal.hit.z - begin + slack;
    if (new_limit < limit) {
      limit = max(new_limit, 0.0);
      rayQueryGenerateIntersectionEXT(query, limit);
    }
  }
  return true;
}

void main() {
  uvec2 pixel = pixel_of_tile(GROUP_IN_TURN, gl_LocalInvocationIndex);
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  precise PixelRay ray = ray_of(pixel);
  precise Traversal traversal = begin_pixel_traversal(pixel, int(state.now.steps));
  bool finished = traversal.hit.z == TRAVERSAL_ENDED || traverse_query(ray, traversal);
  count_bytes(traversal);
  if (!finished) {
    traversal.path = WHOLE;
    enqueue(pixel.y * params.width + pixel.x, traversal);
    return;
  }
  write_pixel(pixel, ray, traversal);
}
