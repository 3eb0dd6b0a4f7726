#include "app/dispatch/tile_lists.h"

#include <cstring>
#include <span>

#include "app/buffers/kernels.h"
#include "app/dispatch/workgroups.h"

namespace trisect {
namespace {

std::span<const std::byte> bytes_of(const TilePush& push) {
  return std::as_bytes(std::span(&push, 1));
}

}  // namespace

TileLists::Tiles::Tiles(const gpu::Device& device, uint32_t width, uint32_t band_rows)
    : counts(device, std::size_t{tiles_across(width)} * tiles_across(band_rows) * sizeof(uint32_t),
             gpu::Memory::device, "subpatch counts of tiles"),
      subpatches(device, counts.size() * TILE_CAPACITY, gpu::Memory::device, "subpatches of tiles"),
      order(device, counts.size(), gpu::Memory::device, "order of tiles") {}

TileLists::TileLists(const gpu::Device& device, const std::vector<gpu::Specialization>& constants,
                     const KernelCode* code, uint32_t subpatches, uint32_t width,
                     uint32_t band_rows)
    : groups_((subpatches + SUBPATCH_GROUP_SIZE - 1) / SUBPATCH_GROUP_SIZE),
      project_kernel_(make_kernel(device, kProjectKernel, constants, code)),
      bin_kernel_(make_kernel(device, kBinKernel, constants, code)),
      sky_kernel_(make_kernel(device, kSkyKernel, constants, code)),
      projected_(device, std::size_t{subpatches} * sizeof(ProjectedSubpatch), gpu::Memory::device,
                 "projected subpatches"),
      tiles_(device, width, band_rows),
      seen_(device, sizeof(uint32_t), gpu::Memory::host, "number of tiles with subpatches") {}

void TileLists::resize(const gpu::Device& device, uint32_t width, uint32_t band_rows) {
  tiles_ = Tiles(device, width, band_rows);
}

double TileLists::project(gpu::Commands& commands, const gpu::DescriptorSet& descriptors) {
  commands.begin();
  commands.dispatch(project_kernel_, descriptors, bytes_of({}), groups_);
  return commands.submit_and_wait();
}

double TileLists::bin(gpu::Commands& commands, const gpu::DescriptorSet& descriptors,
                      uint32_t width, uint32_t first_row, uint32_t rows, uint32_t& tiles_seen) {
  const uint32_t row_groups = (tiles_across(rows) + BIN_ROWS - 1) / BIN_ROWS;
  const TilePush push{{}, 0, first_row, rows};
  commands.begin();
  commands.clear(tiles_.counts);
  commands.clear(seen_);
  commands.dispatch(bin_kernel_, descriptors, bytes_of(push), groups_, row_groups);
  commands.dispatch(sky_kernel_, descriptors, bytes_of(push), tiles_across(width),
                    tiles_across(rows));
  const double ms = commands.submit_and_wait();
  std::memcpy(&tiles_seen, seen_.bytes().data(), sizeof(tiles_seen));
  return ms;
}

}  // namespace trisect
