// How long steps ask their caller whether to go on.
#pragma once

#include <cstdint>
#include <functional>

namespace trisect {

// Asked between two steps, on the thread that called; false: stop here. Empty: nobody is asked.
using KeepGoing = std::function<bool()>;

// Told now and then, on the thread that called, how much of a step is done; returns as KeepGoing.
using Progress = std::function<bool(uint32_t done)>;

inline bool may_go_on(const KeepGoing& keep_going) {
  return !keep_going || keep_going();
}

}  // namespace trisect
