// Lines on a terminal that show the progress of a long step.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace trisect {

// "7 s", "3 min 20 s", "2 h 5 min": a time for a person.
std::string duration_text(double seconds);

// Shows what part of a step is done, and how long the rest will take if it goes on like that. Shows
// nothing for a step that takes less than a second, and nothing at all unless
// shows_progress().
class ProgressLine {
 public:
  explicit ProgressLine(const std::string& step, uint64_t total = 1);
  // Wipes the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

  // done: from 0 to the total. Returns not_interrupted(), so that the call can serve as the
  // progress callback of a long step of the library.
  bool show(double done);

 private:
  std::string step_;
  double total_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double next_ = 1.0;  // seconds from the start until it is shown again
};

// A line with the seconds that a step has taken so far, for a step that reports no progress. It is
// shown while the object lives, under the conditions of ProgressLine.
class BusyLine {
 public:
  explicit BusyLine(const std::string& step);
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
