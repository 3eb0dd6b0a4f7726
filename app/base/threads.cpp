#include "app/base/threads.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace trisect {
namespace {

std::atomic<unsigned> wanted{0};

}  // namespace

unsigned worker_threads() {
  const unsigned count = wanted;
  return count > 0 ? count : std::max(std::thread::hardware_concurrency(), 1U);
}

void set_worker_threads(unsigned count) {
  wanted = count;
}

}  // namespace trisect
