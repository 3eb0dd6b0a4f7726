#version 450
// Traces a frame by the lists of the subpatches whose projections overlap each tile of the image. Rays that Newton's
// method leaves undecided are queued for trace_pending.comp, so that the other rays of their subgroup do not wait for
// them here.
//
// Newton's method is a loop that the lanes of a subgroup leave at different times, and operations of the subgroup follow
// it. All lanes enter that loop together and none ends in it, so that they are together again where the device lets a
// kernel ask for that (vk/capabilities.h); on others structured control flow has them meet where it ends, though Vulkan
// does not promise it.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE * TILE_SIZE) in;

#define TRISECT_WORDS

#include "frame_buffers.glsl"
#ifdef TRISECT_ADDRESSES
#define projected_words WordsAt(uvec2(addresses.projected_low, addresses.projected_high)).items
#else
layout(std430, binding = BINDING_PROJECTED) readonly restrict buffer ProjectedBlock { uvec4 projected_words[]; };
#endif

#include "workgroup_order.glsl"
#include "rays.glsl"
#include "tile_candidates.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "pending.glsl"
#include "intersect_quickly.glsl"
#include "overlaps_rect.glsl"
#include "broadcast.glsl"
#include "broadcast_triangle.glsl"

layout(std430, binding = BINDING_TILE_ORDER) readonly restrict buffer TileOrderBlock { uint tile_order[]; };

// Whether each subgroup is known to have eight lanes or more. The size that a device reports is no promise that so many are
// there (app/dispatch/vulkan_tracer.cpp).
layout(constant_id = CONSTANT_EIGHT_LANES) const bool EIGHT_LANES = false;

// A ProjectedSubpatch is read as uvec4s, of which it has so many. The first four are the culling header: the box and the
// lines that bound the projection in the image. The patch follows.
const uint PROJECTED_WORDS = 12u;
const uint PATCH_WORD = 4u;

// Bytes that an invocation reads: of the header; of the whole record; of the record if the lanes of a subgroup each load a
// share of two vec4s (load_uniform).
const uint HEADER_BYTES = 64u;
const uint PROJECTED_BYTES = 192u;
const uint LANE_SHARE_BYTES = 32u;

vec4 projected_floats(uint word) { return uintBitsToFloat(projected_words[word]); }

// Sets the culling header but for its triangle.
void set_header(vec4 box, vec4 lines_x, vec3 lines_y, vec4 lines_at, inout ProjectedSubpatch projection) {
  projection.box = box;
  projection.lines_x = lines_x;
  projection.lines_y = lines_y;
  projection.lines_at = lines_at;
}

// The culling header of a subpatch, which may differ between the invocations of a subgroup; the rest is undefined.
ProjectedSubpatch load_header(uint subpatch) {
  uint base = subpatch * PROJECTED_WORDS;
  ProjectedSubpatch projection;
  uvec4 lines_y = projected_words[base + 2u];
  set_header(projected_floats(base), projected_floats(base + 1u), uintBitsToFloat(lines_y.xyz), projected_floats(base + 3u),
             projection);
  projection.triangle = lines_y.w;
  return projection;
}

// The whole record of a subpatch that is the same for all invocations of a subgroup. Each lane loads other words of it and
// broadcasts them: llvmpipe executes a load lane by lane, so that loading eight different words, one per lane, costs no
// more than loading the same one in all lanes.
ProjectedSubpatch load_uniform(uint subpatch) {
  uint lane = gl_SubgroupInvocationID;
  uint base = subpatch * PROJECTED_WORDS;
  ProjectedSubpatch projection;
  if (!EIGHT_LANES) {
    projection = load_header(subpatch);
    base += PATCH_WORD;
    projection.P0 = projected_floats(base);
    projection.P1 = projected_floats(base + 1u);
    projection.P2 = projected_floats(base + 2u);
    projection.D0 = projected_floats(base + 3u);
    projection.D1 = projected_floats(base + 4u);
    projection.D2 = projected_floats(base + 5u);
    projection.cone = projected_floats(base + 6u);
    projection.sizes = projected_floats(base + 7u);
    return projection;
  }
  uvec4 loaded = projected_words[base + (lane & 3u)];
  uvec4 lines_y = subgroupBroadcast(loaded, 2);
  set_header(broadcast_floats(loaded, 0), broadcast_floats(loaded, 1), uintBitsToFloat(lines_y.xyz),
             broadcast_floats(loaded, 3), projection);
  projection.triangle = lines_y.w;
  loaded = projected_words[base + PATCH_WORD + (lane & 7u)];
  projection.P0 = broadcast_floats(loaded, 0);
  projection.P1 = broadcast_floats(loaded, 1);
  projection.P2 = broadcast_floats(loaded, 2);
  projection.D0 = broadcast_floats(loaded, 3);
  projection.D1 = broadcast_floats(loaded, 4);
  projection.D2 = broadcast_floats(loaded, 5);
  projection.cone = broadcast_floats(loaded, 6);
  projection.sizes = broadcast_floats(loaded, 7);
  return projection;
}

// Intersects all rays of the subgroup with one subpatch. position: this invocation's, in the image.
void intersect_packet(uint subpatch, PixelRay ray, vec2 position, INOUT(Traversal) traversal, INOUT(Pending) pending) {
  ProjectedSubpatch projection = load_uniform(subpatch);
  if (COUNTS) traversal.counts.bytes += EIGHT_LANES ? LANE_SHARE_BYTES : PROJECTED_BYTES;
  // For the other surfaces Newton's method needs nothing of the triangle beyond the record.
  bool needs_triangle = SURFACE != SURFACE_FLAT && !is_cubic(scene_shape());
  if (COUNTS && needs_triangle) traversal.counts.bytes += EIGHT_LANES ? TRIANGLE_SHARE_BYTES : TRIANGLE_BYTES;
  FramedPatch framed;
  framed.P0 = projection.P0.xyz;
  framed.P1 = projection.P1.xyz;
  framed.P2 = projection.P2.xyz;
  framed.D0 = projection.D0.xyz;
  framed.D1 = projection.D1.xyz;
  framed.D2 = projection.D2.xyz;
  bool near = overlaps_rect(projection, position, vec2(PIXEL_SLACK)) && projection.lines_x.w <= traversal.hit.z;
  SubpatchBounds bounds;
  bounds.corner = vec4(projection.lines_at.w, projection.sizes.z, projection.sizes.w, 0.0);
  bounds.edge = vec4(projection.P0.w, projection.P1.w, projection.P2.w, 0.0);
  bounds.sub_triangle = vec4(projection.D0.w, projection.D1.w, projection.D2.w, projection.sizes.x);
  bounds.cone = projection.cone;
  Triangle tri;
  if (EIGHT_LANES && needs_triangle) {
    tri = load_triangle(projection.triangle);
  } else {
    tri = triangles[projection.triangle];
  }
  intersect_quickly(tri, projection.triangle, bounds, sheared_patch(ray.frame, framed), subpatch, ray,
                    ray.frame.stretch * projection.sizes.y, near, traversal, pending);
}

float least_of(vec4 a) { return min(min(a.x, a.y), min(a.z, a.w)); }

uint least_of(uvec4 a) { return min(min(a.x, a.y), min(a.z, a.w)); }

void main() {
  uint tile = tile_order[GROUP_IN_TURN];
  uvec2 pixel = pixel_of_tile(tile, gl_LocalInvocationIndex) + uvec2(0u, push.first_row);
  vec2 position = vec2(pixel) + vec2(0.5);
  vec2 least = vec2(subgroupMin(position.x), subgroupMin(position.y));
  vec2 largest = vec2(subgroupMax(position.x), subgroupMax(position.y));
  precise PixelRay ray = pixel_ray(pixel);
  ray.tile = tile;
  precise Traversal traversal = begin_traversal(0);
  Pending pending = nothing_pending();
  // Without a list all rays of the tile are left to trace_undecided.comp, and one subpatch is tried in vain.
  TileList list = tile_lists[tile];
  bool is_listed = list.end != NOT_LISTED;
  uint count = is_listed ? list.count : 1u;
  uint begin = list.end - list.count;
  // Some subpatches of the list at a time: each lane tests its own against the rectangle of all the subgroup's pixels, and
  // keeps up to four that overlap it. The lanes are counted: gl_SubgroupSize may be more than are there.
  uint lanes = subgroupMax(gl_SubgroupInvocationID) + 1u;
  uint first = 0u;
  do {
    uvec4 own_subpatches = uvec4(NO_TRIANGLE);
    vec4 own_depths = vec4(1e30);
    do {
      uint item = first + gl_SubgroupInvocationID;
      uint own_subpatch = is_listed ? tile_subpatches[begin + min(item, count - 1u)] : 0u;
      ProjectedSubpatch projection = load_header(own_subpatch);
      if (COUNTS) traversal.counts.bytes += 4u + HEADER_BYTES;
      bool overlaps = item < count && overlaps_rect(projection, 0.5 * (least + largest),
                                                    0.5 * (largest - least) + vec2(PIXEL_SLACK));
      // The first place is taken anew if what is there does not overlap.
      bool keeps = own_depths.x < 1e30;
      own_subpatches = uvec4(own_subpatch, keeps ? own_subpatches.xyz : own_subpatches.yzw);
      own_depths = vec4(overlaps ? projection.lines_x.w : 1e30, keeps ? own_depths.xyz : own_depths.yzw);
      first += lanes;
    } while (first < count && subgroupMin(own_depths.w) == 1e30);
    // Front to back by the least depth of each subpatch, until that is beyond the hits of all rays. If no subpatch overlaps,
    // the loop still intersects one in vain: with the condition at its head llvmpipe would run its body once more than
    // needed every time.
    float next_depth = subgroupMin(least_of(own_depths));
    do {
      uint subpatch = subgroupMin(least_of(mix(uvec4(NO_TRIANGLE), own_subpatches, equal(own_depths, vec4(next_depth)))));
      intersect_packet(subpatch, ray, position, traversal, pending);
      own_depths = mix(own_depths, vec4(1e30), equal(own_subpatches, uvec4(subpatch)));
      next_depth = subgroupMin(least_of(own_depths));
    } while (next_depth < subgroupMax(traversal.hit.z));
  } while (first < count);
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  count_bytes(traversal);
  if (!is_listed) pending.count = TOO_MANY_PENDING;
  if (pending.count > 0u) {
    enqueue_pending(pixel.y * params.width + pixel.x, traversal, pending);
    return;
  }
  write_pixel(pixel, ray, traversal);
}
