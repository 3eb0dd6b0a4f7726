// Rows of an image over all cores.
#pragma once

#include <cstdint>
#include <functional>

namespace trisect {

// Calls row(y) once for every y below `height`, on as many threads as there are cores, and
// progress(rows done), if set, a few times a second and at the end on the calling thread. What
// either throws stops the rest and is thrown here.
void parallel_rows(uint32_t height, const std::function<void(uint32_t)>& row,
                   const std::function<void(uint32_t)>& progress);

}  // namespace trisect
