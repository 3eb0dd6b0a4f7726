// Candidates of a ray: the subpatches in the list of its tile whose bounding balls it meets. If more subpatches overlap the
// tile than its list can hold, all subpatches of the scene are tested instead.

layout(std430, binding = BINDING_TILE_COUNTS) readonly restrict buffer TileCountsBlock { uint tile_counts[]; };
layout(std430, binding = BINDING_TILE_SUBPATCHES) readonly restrict buffer TileSubpatchesBlock {
  uint tile_subpatches[];
};

// Whether more subpatches overlap the tile than its list can hold.
bool is_full(uint tile) { return tile_counts[tile] > TILE_CAPACITY; }

uint candidate_count(uint tile) { return is_full(tile) ? params.subpatch_count : tile_counts[tile]; }

uint candidate_at(uint tile, uint item) { return is_full(tile) ? item : tile_subpatches[tile * TILE_CAPACITY + item]; }

#include "list_traversal.glsl"
