#version 450
// Counts, for every tile of the band, the subpatches whose projections may overlap it; or, with FILLS, enters them into the
// tiles' lists, for which fill_sky.comp has made room. Invocation x looks at subpatch x, workgroup row y at its share of the
// band's rows of tiles.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = SUBPATCH_GROUP_SIZE) in;

#include "frame_buffers.glsl"
layout(std430, binding = BINDING_PROJECTED) readonly restrict buffer ProjectedBlock { ProjectedSubpatch projected[]; };
layout(constant_id = CONSTANT_FILLS) const bool FILLS = false;
layout(std430, binding = BINDING_TILE_LISTS) restrict buffer TileListsBlock { TileList tile_lists[]; };
layout(std430, binding = BINDING_TILE_SUBPATCHES) writeonly restrict buffer TileSubpatchesBlock { uint tile_subpatches[]; };

#include "overlaps_rect.glsl"

// The row or column of tiles in which an image coordinate in pixels lies, clamped to first <= i <= first + count. Clamped
// once as a number, for integers have no room for 1e30, and once as an integer, for a NaN may become any.
int tile_along(float x, int first, int count) {
  int tile = int(clamp(floor(x / float(TILE_SIZE)), float(first), float(first + count)));
  return clamp(tile, first, first + count);
}

void main() {
  uint subpatch = gl_GlobalInvocationID.x;
  if (subpatch >= params.subpatch_count || subpatches[subpatch].skip > 0u) return;
  int columns = int(tiles_across(params.width));
  uint band_rows = tiles_across(push.rows);
  int share = int((band_rows + gl_NumWorkGroups.y - 1u) / gl_NumWorkGroups.y);
  int first_row = int(push.first_row / TILE_SIZE);
  int top = int(gl_WorkGroupID.y) * share;
  // Half a pixel is more than the rounding errors of a projected position.
  vec4 box = projected[subpatch].box;
  int left = tile_along(box.x - 0.5, 0, columns);
  int right = min(tile_along(box.z + 0.5, 0, columns), columns - 1);
  int row = tile_along(box.y - 0.5, first_row + top, share);
  int bottom = min(tile_along(box.w + 0.5, first_row + top, share), first_row + min(top + share, int(band_rows)) - 1);
  if (row > bottom || left > right) return;
  ProjectedSubpatch projection = projected[subpatch];
  vec2 half_size = vec2(0.5 * float(TILE_SIZE));
  int column = left;
  while (row <= bottom) {
    vec2 middle = (vec2(column, row) + vec2(0.5)) * float(TILE_SIZE);
    if (overlaps_rect(projection, middle, half_size)) {
      uint tile = uint((row - first_row) * columns + column);
      if (!FILLS) {
        atomicAdd(tile_lists[tile].count, 1u);
      } else if (tile_lists[tile].end != NOT_LISTED) {
        tile_subpatches[atomicAdd(tile_lists[tile].end, 1u)] = subpatch;
      }
    }
    ++column;
    if (column > right) {
      column = left;
      ++row;
    }
  }
}
