#include "app/base/parallel_rows.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "app/base/threads.h"

namespace trisect {

bool parallel_rows(uint32_t height, const std::function<void(uint32_t, const Stopped&)>& row,
                   const Progress& progress) {
  std::atomic<uint32_t> next = 0;
  std::atomic<uint32_t> done = 0;
  std::mutex mutex;
  std::condition_variable ended;
  std::exception_ptr error;
  Stopped stopped = false;
  const unsigned wanted = worker_threads();
  unsigned running = wanted;
  const auto stop_with = [&](const std::exception_ptr& reason) {
    const std::scoped_lock lock(mutex);
    if (!error) error = reason;
    stopped = true;
    next = height;
  };
  const auto work = [&] {
    try {
      for (uint32_t y = next++; y < height; y = next++) {
        row(y, stopped);
        ++done;
      }
    } catch (...) {
      stop_with(std::current_exception());
    }
    const std::scoped_lock lock(mutex);
    --running;
    ended.notify_one();
  };
  std::vector<std::jthread> threads;
  threads.reserve(wanted);
  try {
    for (unsigned i = 0; i < wanted; ++i) threads.emplace_back(work);
  } catch (const std::system_error&) {
    // There are fewer than there could be, but they, or this one, do the work.
    const std::scoped_lock lock(mutex);
    running -= wanted - static_cast<unsigned>(threads.size());
  }
  if (threads.empty()) {
    running = 1;
    work();
  }
  {
    std::unique_lock lock(mutex);
    while (running > 0) {
      ended.wait_for(lock, std::chrono::milliseconds(200));
      if (!progress || running == 0) continue;
      lock.unlock();
      try {
        if (!progress(done)) {
          stopped = true;
          next = height;
        }
      } catch (...) {
        stop_with(std::current_exception());
      }
      lock.lock();
    }
  }
  threads.clear();
  if (error) std::rethrow_exception(error);
  return !stopped && (!progress || progress(height));
}

bool parallel_rows(uint32_t height, const std::function<void(uint32_t)>& row,
                   const Progress& progress) {
  const auto whole_row = [&row](uint32_t y, const Stopped&) { row(y); };
  return parallel_rows(height, whole_row, progress);
}

bool parallel_chunks(std::size_t count, std::size_t size,
                     const std::function<void(std::size_t, std::size_t)>& chunk,
                     const Progress& progress) {
  const auto tell = [&](std::size_t items) {
    return !progress || progress(static_cast<uint32_t>(std::min(items, count)));
  };
  if (count <= size) {
    if (count > 0) chunk(0, count);
    return tell(count);
  }
  const auto row = [&](uint32_t k) { chunk(k * size, std::min((k + 1) * size, count)); };
  return parallel_rows(static_cast<uint32_t>((count + size - 1) / size), row,
                       [&](uint32_t chunks) { return tell(chunks * size); });
}

}  // namespace trisect
