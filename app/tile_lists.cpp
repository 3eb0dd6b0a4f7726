#include "app/tile_lists.h"

#include <cstring>
#include <span>

#include "app/kernels.h"
#include "app/workgroups.h"

namespace trisect {
namespace {

std::span<const std::byte> bytes_of(const TilePush& push) {
  return std::as_bytes(std::span(&push, 1));
}

}  // namespace

TileLists::TileLists(const gpu::Device& device, const std::vector<gpu::Specialization>& constants,
                     uint32_t parts, uint32_t width, uint32_t band_rows)
    : groups_((parts + PARTS_SIZE - 1) / PARTS_SIZE),
      columns_(tiles_across(width)),
      view_kernel_(device, kViewPartsSpirv, frame_interface(), constants, "view_parts"),
      bin_kernel_(device, kBinPartsSpirv, frame_interface(), constants, "bin_parts"),
      sky_kernel_(device, kFillSkySpirv, frame_interface(), constants, "fill_sky"),
      view_parts_(device, std::size_t{parts} * sizeof(ViewPart), gpu::Memory::device,
                  "parts in view"),
      counts_(device, std::size_t{tiles_across(width)} * tiles_across(band_rows) * sizeof(uint32_t),
              gpu::Memory::device, "number of parts of tiles"),
      tile_parts_(device, counts_.size() * TILE_PARTS, gpu::Memory::device, "parts of tiles"),
      order_(device, counts_.size(), gpu::Memory::device, "order of tiles"),
      seen_(device, sizeof(uint32_t), gpu::Memory::host, "number of tiles that see a part") {}

double TileLists::view(gpu::Commands& commands, const gpu::BoundBuffers& bound) {
  commands.begin();
  commands.dispatch(view_kernel_, bound, bytes_of({}), groups_);
  return commands.submit_and_wait();
}

double TileLists::bin(gpu::Commands& commands, const gpu::BoundBuffers& bound, uint32_t first_row,
                      uint32_t rows, uint32_t& tiles_seen) {
  const uint32_t chunks = (tiles_across(rows) + BIN_ROWS - 1) / BIN_ROWS;
  const TilePush push{{}, 0, first_row, rows};
  commands.begin();
  commands.clear(counts_);
  commands.clear(seen_);
  commands.dispatch(bin_kernel_, bound, bytes_of(push), groups_, chunks);
  commands.dispatch(sky_kernel_, bound, bytes_of(push), columns_, tiles_across(rows));
  const double ms = commands.submit_and_wait();
  std::memcpy(&tiles_seen, seen_.bytes().data(), sizeof(tiles_seen));
  return ms;
}

}  // namespace trisect
