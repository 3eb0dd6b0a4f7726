#version 450
// Writes the sky to the tiles of the band whose lists are empty, and lists the other tiles for trace_tiles.comp.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

#include "frame_buffers.glsl"
layout(std430, binding = BINDING_TILE_ORDER) writeonly restrict buffer TileOrderBlock { uint tile_order[]; };
layout(std430, binding = BINDING_TILES_SEEN) restrict buffer TilesSeenBlock { uint tiles_seen; };

#include "rays.glsl"
#include "tile_candidates.glsl"
#include "trace.glsl"
#include "write_pixel.glsl"

void main() {
  uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (tile_counts[tile] > 0u) {
    if (gl_LocalInvocationIndex == 0u) tile_order[atomicAdd(tiles_seen, 1u)] = tile;
    return;
  }
  uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, push.first_row);
  if (pixel.x >= params.width || pixel.y >= params.height) return;
  precise PixelRay ray = pixel_ray(pixel);
  write_pixel(pixel, ray, begin_traversal(0));
}
