// The parts that a ray goes through: all of them.

uint candidate_count(uint tile) { return params.subpatch_count; }

uint candidate_at(uint tile, uint item) { return item; }

#include "list_traversal.glsl"
