#include "app/dispatch/tile_lists.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "app/dispatch/workgroups.h"

namespace trisect {
namespace {

std::span<const std::byte> bytes_of(const TilePush& push) {
  return std::as_bytes(std::span(&push, 1));
}

// Entries of lists for which there is room at first, for each tile.
constexpr std::size_t kFirstEntries = 16;

}  // namespace

TileLists::Tiles::Tiles(const gpu::Device& device, uint32_t width, uint32_t band_rows)
    : lists(device, std::size_t{tiles_across(width)} * tiles_across(band_rows) * sizeof(TileList),
            gpu::Memory::device, "lists of tiles"),
      subpatches(device, lists.size() / sizeof(TileList) * kFirstEntries * sizeof(uint32_t),
                 gpu::Memory::device, "subpatches of tiles"),
      order(device, lists.size() / sizeof(TileList) * sizeof(uint32_t), gpu::Memory::device,
            "order of tiles") {}

TileLists::TileLists(const gpu::Device& device, uint32_t subpatches, uint32_t width,
                     uint32_t band_rows, std::size_t buffer_limit)
    : groups_((subpatches + SUBPATCH_GROUP_SIZE - 1) / SUBPATCH_GROUP_SIZE),
      rows_of_invocation_(device.is_processor() ? UINT16_MAX : 16),
      buffer_limit_(buffer_limit),
      projected_(device, std::size_t{subpatches} * sizeof(ProjectedSubpatch),
                 device.loads_fast_by_address() ? gpu::Memory::addressed : gpu::Memory::device,
                 "projected subpatches"),
      tiles_(device, width, band_rows),
      totals_(device, sizeof(TileTotals), gpu::Memory::device, "totals of the tiles' lists"),
      counted_(device, sizeof(TileTotals), gpu::Memory::host, "copy of the totals") {}

void TileLists::resize(const gpu::Device& device, uint32_t width, uint32_t band_rows) {
  tiles_ = Tiles(device, width, band_rows);
}

void TileLists::project(gpu::Commands& commands, const TracerKernels& kernels,
                        const gpu::DescriptorSet& descriptors) const {
  commands.dispatch(kernels.project(), descriptors, bytes_of({}), groups_);
}

void TileLists::bin(gpu::Commands& commands, const TracerKernels& kernels,
                    const gpu::DescriptorSet& descriptors, uint32_t width, uint32_t first_row,
                    uint32_t rows) const {
  const uint32_t row_groups = (tiles_across(rows) + rows_of_invocation_ - 1) / rows_of_invocation_;
  const TilePush push{.first_row = first_row, .rows = rows};
  commands.clear(tiles_.lists);
  commands.clear(totals_);
  commands.dispatch(kernels.count(), descriptors, bytes_of(push), groups_, row_groups);
  commands.dispatch(kernels.sky(), descriptors, bytes_of(push), tiles_across(width),
                    tiles_across(rows));
  commands.dispatch(kernels.fill(), descriptors, bytes_of(push), groups_, row_groups);
  commands.copy(totals_, 0, counted_, 0, sizeof(TileTotals));
}

TileTotals TileLists::counted() const {
  TileTotals totals{};
  std::memcpy(&totals, counted_.bytes().data(), sizeof(totals));
  return totals;
}

bool TileLists::grow(const gpu::Device& device) {
  const std::size_t room = tiles_.subpatches.size() / sizeof(uint32_t);
  const std::size_t needed = counted().entries;
  // A quarter more than is needed, so that a camera that moves does not ask for more in each frame.
  const std::size_t larger = std::min(needed + needed / 4, buffer_limit_ / sizeof(uint32_t));
  if (needed <= room || larger <= room) return false;
  tiles_.subpatches =
      gpu::Buffer(device, larger * sizeof(uint32_t), gpu::Memory::device, "subpatches of tiles");
  return true;
}

}  // namespace trisect
