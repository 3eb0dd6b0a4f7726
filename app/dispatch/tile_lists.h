// For every tile of the image, the list of the subpatches whose projections overlap it; made on the
// device for each frame.
#pragma once

#include <cstdint>
#include <vector>

#include "app/dispatch/tracer_kernels.h"
#include "app/surface/shared.h"
#include "vk/commands.h"

namespace trisect {

// For one thread at a time; the device must outlive it.
class TileLists {
 public:
  // subpatches: of the scene. width, band_rows: the largest band of the image in pixels, for which
  // lists are made at a time. buffer_limit: bytes that the lists may take. Throws DeviceError if
  // there is no memory.
  TileLists(const gpu::Device& device, uint32_t subpatches, uint32_t width, uint32_t band_rows,
            std::size_t buffer_limit);

  // For bands of another size. Throws DeviceError if there is no memory.
  void resize(const gpu::Device& device, uint32_t width, uint32_t band_rows);

  // What kernels bind as BINDING_PROJECTED, BINDING_TILE_LISTS, BINDING_TILE_SUBPATCHES,
  // BINDING_TILE_ORDER and BINDING_TILE_TOTALS.
  [[nodiscard]] const gpu::Buffer& projected() const { return projected_; }
  [[nodiscard]] const gpu::Buffer& lists() const { return tiles_.lists; }
  [[nodiscard]] const gpu::Buffer& subpatches() const { return tiles_.subpatches; }
  [[nodiscard]] const gpu::Buffer& order() const { return tiles_.order; }
  [[nodiscard]] const gpu::Buffer& totals() const { return totals_; }

  // Bytes of device memory of all of them.
  [[nodiscard]] std::size_t bytes() const {
    return projected_.size() + tiles_.lists.size() + tiles_.subpatches.size() +
           tiles_.order.size() + totals_.size() + counted_.size();
  }

  // Records: projects all subpatches for the camera in the bound TraceParams. kernels: with those
  // of tiles; descriptors: a set of frame_interface() in which the buffers above are bound.
  void project(gpu::Commands& commands, const TracerKernels& kernels,
               const gpu::DescriptorSet& descriptors) const;

  // Records: makes the lists of the band of `rows` rows from first_row on, and fills in the sky
  // where a list is empty. width: of the image in pixels, at most that of the constructor or of
  // resize().
  void bin(gpu::Commands& commands, const TracerKernels& kernels,
           const gpu::DescriptorSet& descriptors, uint32_t width, uint32_t first_row,
           uint32_t rows) const;

  // The number of tiles whose lists are not empty, in the band of the last submit with bin().
  [[nodiscard]] uint32_t tiles_seen() const { return counted().tiles; }

  // Whether there may be room for more entries of lists.
  [[nodiscard]] bool can_grow() const {
    return tiles_.subpatches.size() / sizeof(uint32_t) < buffer_limit_ / sizeof(uint32_t);
  }

  // If lists of that band were left out for lack of room and can_grow(): makes room for them, with
  // another buffer for subpatches(), and returns true. Throws DeviceError if there is no memory;
  // nothing has changed then.
  bool grow(const gpu::Device& device);

 private:
  // What that band's lists add up to.
  [[nodiscard]] TileTotals counted() const;

  // The buffers whose sizes depend on the image's.
  struct Tiles {
    Tiles(const gpu::Device& device, uint32_t width, uint32_t band_rows);

    gpu::Buffer lists;
    gpu::Buffer subpatches;
    gpu::Buffer order;
  };

  uint32_t groups_;  // workgroups, of SUBPATCH_GROUP_SIZE subpatches each
  // Rows of tiles that an invocation goes through to bin a subpatch. Processors have no use for
  // more invocations.
  uint32_t rows_of_invocation_;
  std::size_t buffer_limit_;
  gpu::Buffer projected_;
  Tiles tiles_;
  gpu::Buffer totals_;
  gpu::Buffer counted_;  // its copy for the host
};

}  // namespace trisect
