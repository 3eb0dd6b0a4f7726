// Work on the rows of an image, or on chunks of a list, spread over threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "app/base/keep_going.h"

namespace trisect {

// Calls row(y) once for every y below `height`, on worker_threads() threads, or as many as the
// system gives: `row` must be safe to call from several threads at once. Calls progress(rows done),
// if set, on the calling thread about five times a second and at the end; where it returns false
// the rows that have not begun are left out. Returns true if every row was done and progress never
// returned false. The first exception that row or progress throws ends the work too and is rethrown
// here.
bool parallel_rows(uint32_t height, const std::function<void(uint32_t)>& row,
                   const Progress& progress);

// The same for rows that take long: row(y, stopped) may end early once `stopped` is true, which it
// is from when progress returned false, or something was thrown.
using Stopped = std::atomic<bool>;
bool parallel_rows(uint32_t height, const std::function<void(uint32_t, const Stopped&)>& row,
                   const Progress& progress);

// Calls chunk(first, end) for consecutive ranges of `size` items of `count`, the last one shorter,
// on as many threads as there are cores: `chunk` must be safe to call from several threads at once.
// The first exception that it throws ends the work and is rethrown here. Calls progress(items done)
// as parallel_rows() does, and returns what that does.
bool parallel_chunks(std::size_t count, std::size_t size,
                     const std::function<void(std::size_t, std::size_t)>& chunk,
                     const Progress& progress = {});

// A size of chunks for items that take some microseconds each.
constexpr std::size_t kChunk = 1024;

}  // namespace trisect
