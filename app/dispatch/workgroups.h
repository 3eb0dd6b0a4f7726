// How an image is cut into the workgroups of trace_list.comp, TILE_SIZE x TILE_SIZE pixels each.
#pragma once

#include <algorithm>
#include <cstdint>

#include "app/surface/shared.h"

namespace trisect {

// Tiles, of a workgroup each, that so many pixels of a row or a column touch.
inline uint32_t tiles_across(uint32_t pixels) {
  return (pixels + TILE_SIZE - 1) / TILE_SIZE;
}

constexpr uint32_t kGroupRays = TILE_SIZE * TILE_SIZE;

// In raster order, from begin to before end.
struct GroupRange {
  uint32_t begin;
  uint32_t end;

  // The most that one submit takes: each of its rays has a place where it can pause.
  [[nodiscard]] uint32_t most() const { return std::min(end - begin, uint32_t{4096}); }
};

// Those of a band: `rows` rows from first_row on, a multiple of TILE_SIZE.
inline GroupRange groups_of_band(uint32_t width, uint32_t first_row, uint32_t rows) {
  const uint32_t groups_x = tiles_across(width);
  const uint32_t begin = first_row / TILE_SIZE * groups_x;
  return {begin, begin + tiles_across(rows) * groups_x};
}

}  // namespace trisect
