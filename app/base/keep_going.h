// How long steps ask their caller whether to go on.
#pragma once

#include <cstdint>
#include <functional>

namespace trisect {

// Asked between two steps, on the thread that called; false: stop here. Empty: nobody is asked.
using KeepGoing = std::function<bool()>;

// Told now and then, on the thread that called, how much of a step is done; returns as KeepGoing.
using Progress = std::function<bool(uint32_t done)>;

// The same, told which part is done, from 0 to 1.
using FractionProgress = std::function<bool(double done)>;

inline bool may_go_on(const FractionProgress& progress, double done) {
  return !progress || progress(done);
}

// For a part of the work that `whole` is told of, which must outlive it: the part's 0 to 1 are
// `from` to `to` of the whole.
inline FractionProgress part_of(const FractionProgress& whole, double from, double to) {
  return [&whole, from, to](double done) { return may_go_on(whole, from + (to - from) * done); };
}

inline bool may_go_on(const KeepGoing& keep_going) {
  return !keep_going || keep_going();
}

}  // namespace trisect
