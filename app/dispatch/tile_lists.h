// The lists of the parts that every tile of the image touches, made on the device for each frame.
#pragma once

#include <cstdint>
#include <vector>

#include "app/buffers/kernel_code.h"
#include "app/surface/shared.h"
#include "vk/commands.h"

namespace trisect {

class TileLists {
 public:
  // constants: those of the kernels that trace; code: compiled anew, or null for what was built in.
  // band_rows: of the bands that lists are made for.
  TileLists(const gpu::Device& device, const std::vector<gpu::Specialization>& constants,
            const KernelCode* code, uint32_t subpatches, uint32_t width, uint32_t band_rows);

  // For images of another size.
  void resize(const gpu::Device& device, uint32_t width, uint32_t band_rows);

  // What kernels bind as BINDING_PROJECTED, BINDING_TILE_COUNTS, BINDING_TILE_SUBPATCHES,
  // BINDING_TILE_ORDER and BINDING_TILES_SEEN.
  [[nodiscard]] const gpu::Buffer& projected() const { return projected_; }
  [[nodiscard]] const gpu::Buffer& counts() const { return tiles_.counts; }
  [[nodiscard]] const gpu::Buffer& subpatches() const { return tiles_.subpatches; }
  [[nodiscard]] const gpu::Buffer& order() const { return tiles_.order; }
  [[nodiscard]] const gpu::Buffer& seen() const { return seen_; }

  // Of all of them.
  [[nodiscard]] std::size_t bytes() const {
    return projected_.size() + tiles_.counts.size() + tiles_.subpatches.size() +
           tiles_.order.size() + seen_.size();
  }

  // Looks at all parts with a new camera. Milliseconds on the device, as below.
  double view(gpu::Commands& commands, const gpu::DescriptorSet& bound);

  // Makes the lists of a band, and fills in the sky where they are empty. width: of the image, at
  // most that which the lists were made for. tiles_seen: how many are not empty.
  double bin(gpu::Commands& commands, const gpu::DescriptorSet& bound, uint32_t width,
             uint32_t first_row, uint32_t rows, uint32_t& tiles_seen);

 private:
  // What depends on the image's size.
  struct Tiles {
    Tiles(const gpu::Device& device, uint32_t width, uint32_t band_rows);

    gpu::Buffer counts;
    gpu::Buffer subpatches;
    gpu::Buffer order;
  };

  uint32_t groups_;  // of parts
  gpu::Kernel view_kernel_;
  gpu::Kernel bin_kernel_;
  gpu::Kernel sky_kernel_;
  gpu::Buffer projected_;
  Tiles tiles_;
  gpu::Buffer seen_;
};

}  // namespace trisect
