#include "app/buffers/buffer_limits.h"

#include <fmt/format.h>
#include "app/base/error.h"

#include <algorithm>

namespace trisect {
namespace {

template <typename T>
std::size_t bytes_of(const std::string& device, std::size_t limit, const std::vector<T>& items,
                     const char* items_take) {
  const std::size_t bytes = std::max<std::size_t>(items.size(), 1) * sizeof(T);
  if (bytes > limit) {
    throw DeviceError(fmt::format("device {} has storage buffers of at most {} bytes; {} {}.",
                                  device, limit, items_take, bytes));
  }
  return bytes;
}

}  // namespace

std::size_t triangle_bytes(const std::string& device, std::size_t limit, const BakedScene& scene) {
  const std::size_t bytes = scene.triangles.size() * sizeof(Triangle);
  if (bytes > limit) {
    throw DeviceError(
        fmt::format("device {} has storage buffers of at most {} bytes, which hold {} triangles; "
                    "the model has {}.",
                    device, limit, limit / sizeof(Triangle), scene.triangles.size()));
  }
  return bytes;
}

std::size_t subpatch_bytes(const std::string& device, std::size_t limit, const BakedScene& scene) {
  return bytes_of(device, limit, scene.subpatches, "the bounds of the model's patches take");
}

std::size_t bvh_bytes(const std::string& device, std::size_t limit, const BakedScene& scene) {
  return bytes_of(device, limit, scene.bvh, "the tree over the model's patches takes");
}

uint32_t rows_in_a_band(const std::string& device, std::size_t limit, uint32_t width,
                        uint32_t height, bool aovs) {
  const std::size_t row = std::size_t{width} * (aovs ? sizeof(PixelAovs) : sizeof(vec4));
  const std::size_t fit = limit / row / TILE_SIZE * TILE_SIZE;
  if (fit == 0) {
    throw DeviceError(fmt::format("device {} cannot hold {} rows of {} pixels in one buffer.",
                                  device, TILE_SIZE, width));
  }
  return static_cast<uint32_t>(std::min<std::size_t>(fit, height));
}

}  // namespace trisect
