// How an image is divided into tiles of TILE_SIZE x TILE_SIZE pixels, each the work of a workgroup.
#pragma once

#include <algorithm>
#include <cstdint>

#include "app/surface/shared.h"

namespace trisect {

// The number of tiles that cover so many pixels of a row or a column.
inline uint32_t tiles_across(uint32_t pixels) {
  return (pixels + TILE_SIZE - 1) / TILE_SIZE;
}

constexpr uint32_t kGroupRays = TILE_SIZE * TILE_SIZE;

// Workgroups of an image by their indices in raster order, begin <= i < end.
struct GroupRange {
  uint32_t begin;
  uint32_t end;

  // The most workgroups traced at a time: for each of their rays the queue needs a place.
  [[nodiscard]] uint32_t part_limit() const { return std::min(end - begin, uint32_t{4096}); }
};

// The workgroups of a band of the image: `rows` rows from first_row on, a multiple of TILE_SIZE.
inline GroupRange groups_of_band(uint32_t width, uint32_t first_row, uint32_t rows) {
  const uint32_t groups_x = tiles_across(width);
  const uint32_t begin = first_row / TILE_SIZE * groups_x;
  return {begin, begin + tiles_across(rows) * groups_x};
}

}  // namespace trisect
