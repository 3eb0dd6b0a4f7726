#version 450
// Writes the sky to the tiles of the band without a subpatch. Numbers the other tiles for trace_tiles.comp, and makes room
// for their lists.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

#include "frame_buffers.glsl"
layout(std430, binding = BINDING_TILE_ORDER) writeonly restrict buffer TileOrderBlock { uint tile_order[]; };
layout(std430, binding = BINDING_TILE_TOTALS) restrict buffer TileTotalsBlock { TileTotals totals; };
layout(std430, binding = BINDING_TILE_LISTS) restrict buffer TileListsBlock { TileList tile_lists[]; };
layout(std430, binding = BINDING_TILE_SUBPATCHES) readonly restrict buffer TileSubpatchesBlock {
  uint tile_subpatches[];
};

#include "rays.glsl"
#include "every_candidate.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"

// Numbers the tile, which has so many subpatches, and makes room for its list.
void make_list(uint tile, uint count) {
  tile_order[atomicAdd(totals.tiles, 1u)] = tile;
  uint first = count <= TILE_CAPACITY ? atomicAdd(totals.entries, count) : NOT_LISTED;
  uint room = uint(tile_subpatches.length());
  bool fits = first < room && count <= room - first;
  tile_lists[tile].end = fits ? first : NOT_LISTED;
}

void main() {
  uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, push.first_row);
  uint count = tile_lists[tile].count;
  if (count > 0u) {
    if (gl_LocalInvocationIndex == 0u) make_list(tile, count);
  } else if (pixel.x < params.width && pixel.y < params.height) {
    precise PixelRay ray = pixel_ray(pixel);
    write_pixel(pixel, ray, begin_traversal(0));
  }
}
