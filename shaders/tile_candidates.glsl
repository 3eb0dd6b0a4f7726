// Candidates of a ray: the subpatches in the list of its tile whose bounding balls it meets. A tile without a list has all
// subpatches of the scene for candidates.

layout(std430, binding = BINDING_TILE_LISTS) readonly restrict buffer TileListsBlock { TileList tile_lists[]; };
layout(std430, binding = BINDING_TILE_SUBPATCHES) readonly restrict buffer TileSubpatchesBlock {
  uint tile_subpatches[];
};

uint candidate_count(uint tile) {
  TileList list = tile_lists[tile];
  return list.end == NOT_LISTED ? params.subpatch_count : list.count;
}

uint candidate_at(uint tile, uint item) {
  TileList list = tile_lists[tile];
  return list.end == NOT_LISTED ? item : tile_subpatches[list.end - list.count + item];
}

#include "list_traversal.glsl"
