#version 450
// The renderer over lists of the parts that tiles of the image touch. What Newton's method does not decide at once is
// left to trace_undecided.comp: no ray waits here for a difficult neighbour.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE * TILE_SIZE) in;

#include "frame_buffers.glsl"
layout(std430, binding = BINDING_PROJECTED) readonly restrict buffer ProjectedBlock { vec4 projected_words[]; };

#include "rays.glsl"
#include "tile_candidates.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "intersect_quickly.glsl"
#include "overlaps_rect.glsl"

layout(std430, binding = BINDING_TILE_ORDER) readonly restrict buffer TileOrderBlock { uint tile_order[]; };

// Words of vec4 of a ProjectedSubpatch, and the first of its patch.
const uint VIEW_WORDS = 12u;
const uint PATCH_WORD = 4u;

// Where in the image a part is seen takes its first words. What is read of it by all invocations of a subgroup, and what one
// of them reads if each loads some of that.
const uint SEEN_BYTES = 64u;
const uint VIEW_BYTES = 192u;
const uint SHARE_BYTES = 32u;

// Where in the image the part is seen; every invocation of a subgroup may ask for another one.
ProjectedSubpatch seen_by_one(uint subpatch) {
  ProjectedSubpatch view;
  view.box = projected_words[subpatch * VIEW_WORDS];
  view.lines_x = projected_words[subpatch * VIEW_WORDS + 1u];
  view.lines_y = projected_words[subpatch * VIEW_WORDS + 2u];
  view.lines_at = projected_words[subpatch * VIEW_WORDS + 3u];
  return view;
}

// The part for which all invocations of a subgroup ask. Each loads a word, which the others get from it: llvmpipe makes
// a loop over the invocations of every load, so that one load of eight words costs no more than one of the same word.
ProjectedSubpatch view_by_all(uint subpatch) {
  uint lane = gl_SubgroupInvocationID;
  uint base = subpatch * VIEW_WORDS;
  ProjectedSubpatch view;
  if (gl_SubgroupSize < 8u) {
    view = seen_by_one(subpatch);
    view.P0 = projected_words[base + PATCH_WORD];
    view.P1 = projected_words[base + PATCH_WORD + 1u];
    view.P2 = projected_words[base + PATCH_WORD + 2u];
    view.D0 = projected_words[base + PATCH_WORD + 3u];
    view.D1 = projected_words[base + PATCH_WORD + 4u];
    view.D2 = projected_words[base + PATCH_WORD + 5u];
    view.cone = projected_words[base + PATCH_WORD + 6u];
    view.sizes = projected_words[base + PATCH_WORD + 7u];
    return view;
  }
  vec4 word = projected_words[base + (lane & 3u)];
  view.box = subgroupBroadcast(word, 0);
  view.lines_x = subgroupBroadcast(word, 1);
  view.lines_y = subgroupBroadcast(word, 2);
  view.lines_at = subgroupBroadcast(word, 3);
  word = projected_words[base + PATCH_WORD + (lane & 7u)];
  view.P0 = subgroupBroadcast(word, 0);
  view.P1 = subgroupBroadcast(word, 1);
  view.P2 = subgroupBroadcast(word, 2);
  view.D0 = subgroupBroadcast(word, 3);
  view.D1 = subgroupBroadcast(word, 4);
  view.D2 = subgroupBroadcast(word, 5);
  view.cone = subgroupBroadcast(word, 6);
  view.sizes = subgroupBroadcast(word, 7);
  return view;
}

// One part, all rays of the subgroup.
void meet(uint subpatch, PixelRay ray, vec2 position, INOUT(Traversal) traversal, INOUT(bool) undecided) {
  ProjectedSubpatch view = view_by_all(subpatch);
  if (COUNTS) traversal.counts.bytes += gl_SubgroupSize < 8u ? VIEW_BYTES : SHARE_BYTES;
  // Newton's method needs nothing else of the triangle, but for blended spheres.
  if (COUNTS && SURFACE == SURFACE_SPHERE) traversal.counts.bytes += TRIANGLE_BYTES;
  FramedPatch at;
  at.P0 = view.P0.xyz;
  at.P1 = view.P1.xyz;
  at.P2 = view.P2.xyz;
  at.D0 = view.D0.xyz;
  at.D1 = view.D1.xyz;
  at.D2 = view.D2.xyz;
  bool here = overlaps_rect(view, position, vec2(PIXEL_SLACK));
  SubpatchBounds bounds;
  bounds.edge = vec4(view.P0.w, view.P1.w, view.P2.w, 0.0);
  bounds.sub_triangle = vec4(view.D0.w, view.D1.w, view.D2.w, view.sizes.x);
  bounds.cone = view.cone;
  uint triangle = uint(view.lines_y.w);
  intersect_quickly(triangles[triangle], triangle, bounds, sheared_patch(ray.frame, at), subpatch, ray,
               ray.frame.stretch * view.sizes.y, here, traversal, undecided);
}

void main() {
  uint tile = tile_order[push.first_group + gl_WorkGroupID.x];
  uint columns = tiles_across(params.width);
  uvec2 pixel = uvec2(tile % columns, tile / columns) * TILE_SIZE + uvec2(0u, push.first_row) + pixel_in_tile(gl_LocalInvocationIndex);
  vec2 position = vec2(pixel) + vec2(0.5);
  vec2 least = vec2(subgroupMin(position.x), subgroupMin(position.y));
  vec2 largest = vec2(subgroupMax(position.x), subgroupMax(position.y));
  precise PixelRay ray = pixel_ray(pixel);
  ray.tile = tile;
  precise Traversal traversal = begin_traversal(0);
  bool undecided = is_full(tile);
  uint count = undecided ? 1u : tile_counts[tile];
  // As many parts at a time as there are invocations, each of which looks whether the subgroup sees its own.
  uint first = 0u;
  do {
    uint item = first + gl_SubgroupInvocationID;
    uint mine = tile_subpatches[tile * TILE_CAPACITY + min(item, count - 1u)];
    ProjectedSubpatch view = seen_by_one(mine);
    if (COUNTS) traversal.counts.bytes += 4u + SEEN_BYTES;
    bool seen = item < count && overlaps_rect(view, 0.5 * (least + largest), 0.5 * (largest - least) + vec2(PIXEL_SLACK));
    float begins = seen ? view.lines_x.w : 1e30;
    // Front to back, as long as a part begins before what the rays have met. Of a subgroup that sees none one part is
    // tried in vain: with the condition at the loop's head llvmpipe would always try one more.
    float next = subgroupMin(begins);
    do {
      uint subpatch = subgroupMin(begins == next ? mine : NO_TRIANGLE);
      meet(subpatch, ray, position, traversal, undecided);
      if (mine == subpatch) begins = 1e30;
      next = subgroupMin(begins);
    } while (next < subgroupMax(traversal.hit.z));
    first += gl_SubgroupSize;
  } while (first < count);
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  count_bytes(traversal);
  if (undecided) {
    // From the first part of the list on.
    enqueue(pixel.y * params.width + pixel.x, traversal);
    return;
  }
  write_pixel(pixel, ray, traversal);
}
