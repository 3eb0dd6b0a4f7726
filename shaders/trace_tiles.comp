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
layout(std430, binding = BINDING_VIEW_PARTS) readonly restrict buffer ViewPartsBlock { vec4 view_words[]; };

#include "rays.glsl"
#include "tile_candidates.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"
#include "queue.glsl"
#include "intersect_quickly.glsl"
#include "overlaps_rect.glsl"

layout(std430, binding = BINDING_TILE_ORDER) readonly restrict buffer TileOrderBlock { uint tile_order[]; };

// Words of vec4 of a ViewPart, and the first of its patch.
const uint VIEW_WORDS = 12u;
const uint PATCH_WORD = 4u;

// Where in the image a part is seen takes its first words. What is read of it by all invocations of a subgroup, and what one
// of them reads if each loads some of that.
const uint SEEN_BYTES = 64u;
const uint VIEW_BYTES = 192u;
const uint SHARE_BYTES = 32u;

// Where in the image the part is seen; every invocation of a subgroup may ask for another one.
ViewPart seen_by_one(uint part) {
  ViewPart view;
  view.box = view_words[part * VIEW_WORDS];
  view.lines_x = view_words[part * VIEW_WORDS + 1u];
  view.lines_y = view_words[part * VIEW_WORDS + 2u];
  view.lines_at = view_words[part * VIEW_WORDS + 3u];
  return view;
}

// The part for which all invocations of a subgroup ask. Each loads a word, which the others get from it: llvmpipe makes
// a loop over the invocations of every load, so that one load of eight words costs no more than one of the same word.
ViewPart view_by_all(uint part) {
  uint lane = gl_SubgroupInvocationID;
  uint base = part * VIEW_WORDS;
  ViewPart view;
  if (gl_SubgroupSize < 8u) {
    view = seen_by_one(part);
    view.P0 = view_words[base + PATCH_WORD];
    view.P1 = view_words[base + PATCH_WORD + 1u];
    view.P2 = view_words[base + PATCH_WORD + 2u];
    view.D0 = view_words[base + PATCH_WORD + 3u];
    view.D1 = view_words[base + PATCH_WORD + 4u];
    view.D2 = view_words[base + PATCH_WORD + 5u];
    view.cone = view_words[base + PATCH_WORD + 6u];
    view.sizes = view_words[base + PATCH_WORD + 7u];
    return view;
  }
  vec4 word = view_words[base + (lane & 3u)];
  view.box = subgroupBroadcast(word, 0);
  view.lines_x = subgroupBroadcast(word, 1);
  view.lines_y = subgroupBroadcast(word, 2);
  view.lines_at = subgroupBroadcast(word, 3);
  word = view_words[base + PATCH_WORD + (lane & 7u)];
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
void meet(uint part, PixelRay ray, vec2 position, INOUT(Walk) walk, INOUT(bool) undecided) {
  ViewPart view = view_by_all(part);
  if (COUNTS) walk.counts.bytes += gl_SubgroupSize < 8u ? VIEW_BYTES : SHARE_BYTES;
  // Newton's method needs nothing else of the triangle, but for blended spheres.
  if (COUNTS && SURFACE == SURFACE_SPHERE) walk.counts.bytes += TRIANGLE_BYTES;
  FramedPatch at;
  at.P0 = view.P0.xyz;
  at.P1 = view.P1.xyz;
  at.P2 = view.P2.xyz;
  at.D0 = view.D0.xyz;
  at.D1 = view.D1.xyz;
  at.D2 = view.D2.xyz;
  bool here = may_see(view, position, vec2(PIXEL_SLACK));
  Cage cage;
  cage.edge = vec4(view.P0.w, view.P1.w, view.P2.w, 0.0);
  cage.node = vec4(view.D0.w, view.D1.w, view.D2.w, view.sizes.x);
  cage.cone = view.cone;
  uint triangle = uint(view.lines_y.w);
  meet_quickly(triangles[triangle], triangle, cage, sheared_patch(ray.frame, at), part, ray,
               ray.frame.stretch * view.sizes.y, here, walk, undecided);
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
  precise Walk walk = walk_begun(0);
  bool undecided = is_full(tile);
  uint count = undecided ? 1u : tile_counts[tile];
  // As many parts at a time as there are invocations, each of which looks whether the subgroup sees its own.
  uint first = 0u;
  do {
    uint item = first + gl_SubgroupInvocationID;
    uint mine = tile_parts[tile * TILE_PARTS + min(item, count - 1u)];
    ViewPart view = seen_by_one(mine);
    if (COUNTS) walk.counts.bytes += 4u + SEEN_BYTES;
    bool seen = item < count && may_see(view, 0.5 * (least + largest), 0.5 * (largest - least) + vec2(PIXEL_SLACK));
    float begins = seen ? view.lines_x.w : 1e30;
    // Front to back, as long as a part begins before what the rays have met. Of a subgroup that sees none one part is
    // tried in vain: with the condition at the loop's head llvmpipe would always try one more.
    float next = subgroupMin(begins);
    do {
      uint part = subgroupMin(begins == next ? mine : NO_TRIANGLE);
      meet(part, ray, position, walk, undecided);
      if (mine == part) begins = 1e30;
      next = subgroupMin(begins);
    } while (next < subgroupMax(walk.hit.z));
    first += gl_SubgroupSize;
  } while (first < count);
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  count_bytes(walk);
  if (undecided) {
    // From the first part of the list on.
    enqueue(pixel.y * params.width + pixel.x, walk);
    return;
  }
  write_pixel(pixel, ray, walk);
}
