// A line on a terminal that says how far a long step is.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

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

}  // namespace trisect
