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
class Progress {
 public:
  Progress(std::string step, uint64_t total);
  // Wipes the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  // done: of the total. Throws Interrupted if the user asked for it.
  void show(uint64_t done);

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
