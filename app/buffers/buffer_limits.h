// Sizes of the storage buffers for a scene and an image, checked against a device's limit. Vulkan
// and OpenGL share these functions, so a scene that is too large gives the same message on both.
//
// In all of them `device` is the device's name, for the message, and `limit` the most bytes that
// one storage buffer may have. They throw DeviceError if the buffer would need more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "app/bake/bake.h"
#include "app/base/error.h"

namespace trisect {

inline constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// Bytes of the scene's triangles.
std::size_t triangle_bytes(const std::string& device, std::size_t limit, const BakedScene& scene);

// Bytes of the scene's SubpatchBounds; those of one if it has none, because a binding needs a
// buffer even if the solver does not read it.
std::size_t subpatch_bytes(const std::string& device, std::size_t limit, const BakedScene& scene);

// Bytes of the scene's BVH, or of one entry if it has none.
std::size_t bvh_bytes(const std::string& device, std::size_t limit, const BakedScene& scene);

// How many rows of an image of width x height pixels the output buffers hold at a time: all of them
// if they fit, else the largest multiple of TILE_SIZE that fits. aovs: whether PixelAovs are among
// the outputs.
uint32_t rows_in_a_band(const std::string& device, std::size_t limit, uint32_t width,
                        uint32_t height, bool aovs);

}  // namespace trisect
