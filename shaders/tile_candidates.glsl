// The parts that a ray goes through: those that its tile of the image touches.

layout(std430, binding = BINDING_TILE_COUNTS) readonly restrict buffer TileCountsBlock { uint tile_counts[]; };
layout(std430, binding = BINDING_TILE_PARTS) readonly restrict buffer TilePartsBlock { uint tile_parts[]; };

// Whether more parts touch the tile than its list holds.
bool is_full(uint tile) { return tile_counts[tile] > TILE_PARTS; }

uint part_count(uint tile) { return is_full(tile) ? params.cage_count : tile_counts[tile]; }

uint part_at(uint tile, uint item) { return is_full(tile) ? item : tile_parts[tile * TILE_PARTS + item]; }

#include "list_traversal.glsl"
