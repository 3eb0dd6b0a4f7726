// The lists of the parts that every tile of the image touches, made on the device for each frame.
#pragma once

#include <cstdint>
#include <vector>

#include "app/shared.h"
#include "vk/commands.h"

namespace trisect {

class TileLists {
 public:
  // constants: those of the kernels that trace. band_rows: of the bands that lists are made for.
  TileLists(const gpu::Device& device, const std::vector<gpu::Specialization>& constants,
            uint32_t parts, uint32_t width, uint32_t band_rows);

  // What kernels bind as BINDING_VIEW_PARTS, BINDING_TILE_COUNTS, BINDING_TILE_PARTS,
  // BINDING_TILE_ORDER and BINDING_TILES_SEEN.
  [[nodiscard]] const gpu::Buffer& view_parts() const { return view_parts_; }
  [[nodiscard]] const gpu::Buffer& counts() const { return counts_; }
  [[nodiscard]] const gpu::Buffer& parts() const { return tile_parts_; }
  [[nodiscard]] const gpu::Buffer& order() const { return order_; }
  [[nodiscard]] const gpu::Buffer& seen() const { return seen_; }

  // Looks at all parts with a new camera. Milliseconds on the device, as below.
  double view(gpu::Commands& commands, const gpu::BoundBuffers& bound);

  // Makes the lists of a band, and fills in the sky where they are empty. tiles_seen: how many are
  // not.
  double bin(gpu::Commands& commands, const gpu::BoundBuffers& bound, uint32_t first_row,
             uint32_t rows, uint32_t& tiles_seen);

 private:
  uint32_t groups_;   // of parts
  uint32_t columns_;  // of tiles
  gpu::Kernel view_kernel_;
  gpu::Kernel bin_kernel_;
  gpu::Kernel sky_kernel_;
  gpu::Buffer view_parts_;
  gpu::Buffer counts_;
  gpu::Buffer tile_parts_;
  gpu::Buffer order_;
  gpu::Buffer seen_;
};

}  // namespace trisect
