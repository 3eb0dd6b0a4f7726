// Rows of an image, or chunks of a list, over all cores.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "app/base/keep_going.h"

namespace trisect {

// Calls row(y) once for every y below `height`, on as many threads as there are cores, and
// progress(rows done), if set, a few times a second and at the end on the calling thread. Returns
// whether every row was done: not if progress said stop. What row or progress throws stops the rest
// and is thrown here.
bool parallel_rows(uint32_t height, const std::function<void(uint32_t)>& row,
                   const Progress& progress);

// Calls chunk(first, end) for consecutive ranges of `size` items of `count`, the last one shorter,
// on as many threads as there are cores. What it throws stops the rest and is thrown here.
void parallel_chunks(std::size_t count, std::size_t size,
                     const std::function<void(std::size_t, std::size_t)>& chunk);

// Of items that take some microseconds each.
constexpr std::size_t kChunk = 1024;

}  // namespace trisect
