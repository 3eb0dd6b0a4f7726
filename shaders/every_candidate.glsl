// The parts that a ray goes through: all of them.

uint part_count(uint tile) { return params.cage_count; }

uint part_at(uint tile, uint item) { return item; }

#include "list_traversal.glsl"
