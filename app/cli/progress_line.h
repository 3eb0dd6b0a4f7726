// Lines on a terminal that say how far a long step is.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace trisect {

// Nothing is shown of a step that takes less than a second, and nothing at all where standard error
// is not a terminal.
class ProgressLine {
 public:
  ProgressLine(std::string step, uint64_t total);
  // Wipes the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

  // done: of the total. Returns not_interrupted(): what long steps of the library want to know.
  bool show(uint64_t done);

 private:
  std::string step_;
  uint64_t total_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool shown_ = false;
};

// A line that says how long a step has taken for which nobody knows how far it is. Shown as long as
// it lives, under the same conditions.
class BusyLine {
 public:
  explicit BusyLine(std::string step);
  // Wipes the line.
  ~BusyLine();
  BusyLine(const BusyLine&) = delete;
  BusyLine& operator=(const BusyLine&) = delete;
  BusyLine(BusyLine&&) = delete;
  BusyLine& operator=(BusyLine&&) = delete;

 private:
  void show_until_ended();

  std::string step_;
  std::mutex mutex_;
  std::condition_variable end_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace trisect
