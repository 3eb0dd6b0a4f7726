#version 450
// Appends every part to the lists of the band's tiles that may see it. x: parts; y: BIN_ROWS rows of tiles each.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = SUBPATCH_GROUP_SIZE) in;

#include "frame_buffers.glsl"
layout(std430, binding = BINDING_PROJECTED) readonly restrict buffer ProjectedBlock { ProjectedSubpatch projected[]; };
layout(std430, binding = BINDING_TILE_COUNTS) restrict buffer TileCountsBlock { uint tile_counts[]; };
layout(std430, binding = BINDING_TILE_SUBPATCHES) writeonly restrict buffer TileSubpatchesBlock { uint tile_subpatches[]; };

#include "overlaps_rect.glsl"

// The row or column of tiles, of `count` from `first` on, in which an image coordinate lies; first + count if beyond.
int tile_along(float x, int first, int count) {
  return int(clamp(floor(x / float(TILE_SIZE)), float(first), float(first + count)));
}

void main() {
  uint subpatch = gl_GlobalInvocationID.x;
  if (subpatch >= params.subpatch_count || subpatches[subpatch].skip > 0u) return;
  ProjectedSubpatch view = projected[subpatch];
  int columns = int(tiles_across(params.width));
  int band_rows = int(tiles_across(push.rows));
  int first_row = int(push.first_row / TILE_SIZE);
  int top = int(gl_WorkGroupID.y) * BIN_ROWS;
  // Tiles are tested with half a pixel around them: more than the roundings of a position.
  int left = tile_along(view.box.x - 0.5, 0, columns);
  int right = min(tile_along(view.box.z + 0.5, 0, columns), columns - 1);
  int row = tile_along(view.box.y - 0.5, first_row + top, BIN_ROWS);
  int bottom = min(tile_along(view.box.w + 0.5, first_row + top, BIN_ROWS),
                   first_row + min(top + BIN_ROWS, band_rows) - 1);
  vec2 half_size = vec2(0.5 * float(TILE_SIZE));
  int column = left;
  while (row <= bottom && left <= right) {
    vec2 middle = (vec2(column, row) + vec2(0.5)) * float(TILE_SIZE);
    if (overlaps_rect(view, middle, half_size)) {
      uint tile = uint((row - first_row) * columns + column);
      uint place = atomicAdd(tile_counts[tile], 1u);
      if (place < TILE_CAPACITY) tile_subpatches[tile * TILE_CAPACITY + place] = subpatch;
    }
    ++column;
    if (column > right) {
      column = left;
      ++row;
    }
  }
}
