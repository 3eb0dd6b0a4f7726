// What fits into a device's storage buffers: the same sentences for every API.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "app/bake/bake.h"
#include "app/base/error.h"

namespace trisect {

inline constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// All of them throw DeviceError, naming the device, if a buffer of `limit` bytes is too small.

std::size_t triangle_bytes(const std::string& device, std::size_t limit, const BakedScene& scene);

// Of one cage at least: a binding wants a buffer, also if no solver reads it.
std::size_t subpatch_bytes(const std::string& device, std::size_t limit, const BakedScene& scene);

// Of one entry at least, likewise.
std::size_t bvh_bytes(const std::string& device, std::size_t limit, const BakedScene& scene);

// Rows of the image that the output buffers hold at a time: all of them if buffers of so many bytes
// allow, else a whole number of workgroups.
uint32_t rows_in_a_band(const std::string& device, std::size_t limit, uint32_t width,
                        uint32_t height, bool aovs);

}  // namespace trisect
