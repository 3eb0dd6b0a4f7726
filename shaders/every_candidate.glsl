// Candidates of a ray: all subpatches whose bounding balls it meets.

uint candidate_count(uint tile) { return params.subpatch_count; }

uint candidate_at(uint tile, uint item) { return item; }

#include "list_traversal.glsl"
