// How many workgroups go into one submit.
#pragma once

#include <algorithm>
#include <cstdint>

namespace trisect {

// A submit should keep the device busy for no longer than kSubmitMs: drivers reset a device that
// does not answer for about two seconds, and a desktop that shares it stutters long before. The
// cost of a workgroup is learned from the submits so far: it is that of the most expensive one,
// since the next rows of the image may cost as much. It decays, so that one submit that was delayed
// by something else does not count forever. A submit is at most twice as large as the largest one
// so far.
class SubmitBudget {
 public:
  static constexpr double kSubmitMs = 100.0;

  // Workgroups for the next submit; at least one.
  [[nodiscard]] uint32_t groups() const {
    if (largest_ == 0) return kFirstGroups;
    const double affordable = kSubmitMs / std::max(ms_per_group_, 1e-9);
    return static_cast<uint32_t>(std::clamp(affordable, 1.0, 2.0 * largest_));
  }

  // A submit of so many workgroups took so many milliseconds.
  void record(uint32_t groups, double ms) {
    largest_ = std::max(largest_, static_cast<double>(std::max(groups, kFirstGroups)));
    ms_per_group_ = std::max(kDecay * ms_per_group_, ms / groups);
  }

 private:
  // Of the first submit, of which nothing is known.
  static constexpr uint32_t kFirstGroups = 16;
  // The factor by which the cost decays with every submit that is cheaper. A cost a hundred times
  // too high is gone after 16 submits, which is less than a frame; the few cheap submits of an
  // empty sky do not make it forget what the model below costs.
  static constexpr double kDecay = 0.75;

  double largest_ = 0.0;
  double ms_per_group_ = 0.0;
};

}  // namespace trisect
