// How much work goes into one submit.
#pragma once

#include <algorithm>
#include <cstdint>

namespace trisect {

// A submit should keep the device no longer than kSubmitMs: drivers reset a device that does not
// answer for about two seconds, and a desktop that shares it stutters long before. What a workgroup
// costs is learned: from the dearest submit so far, since the next rows may be as dear, but one
// that something else held up is forgotten by and by; and the size of a submit no more than doubles
// from the largest one known.
class SubmitBudget {
 public:
  static constexpr double kSubmitMs = 100.0;

  // Workgroups of the next submit, one or more.
  [[nodiscard]] uint32_t groups() const {
    if (largest_ == 0) return kFirstGroups;
    const double affordable = kSubmitMs / std::max(dearest_ms_per_group_, 1e-9);
    return static_cast<uint32_t>(std::clamp(affordable, 1.0, 2.0 * largest_));
  }

  void record(uint32_t groups, double ms) {
    largest_ = std::max(largest_, static_cast<double>(std::max(groups, kFirstGroups)));
    dearest_ms_per_group_ = std::max(kMemory * dearest_ms_per_group_, ms / groups);
  }

 private:
  // Before anything is known.
  static constexpr uint32_t kFirstGroups = 16;
  // What is left of a cost with every submit that is cheaper: a hundredfold is forgotten in 16,
  // which is less than a frame; the few submits of an empty sky take little from that of what
  // follows it.
  static constexpr double kMemory = 0.75;

  double largest_ = 0.0;
  double dearest_ms_per_group_ = 0.0;
};

}  // namespace trisect
