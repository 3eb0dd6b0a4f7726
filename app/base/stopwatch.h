// Elapsed time by the host's monotonic clock, and the processor time of all threads.
#pragma once

#include <chrono>
#include <ctime>

namespace trisect {

// Measures from its construction on.
class Stopwatch {
 public:
  [[nodiscard]] double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
        .count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Measures from its construction on what the process's threads take together.
class CpuStopwatch {
 public:
  [[nodiscard]] double milliseconds() const {
    return 1000.0 * static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace trisect
