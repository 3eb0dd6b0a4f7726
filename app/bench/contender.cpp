#include "app/bench/contender.h"

#include <chrono>

namespace trisect::bench {

Timing take_turn(Contender& contender, Frame& frame) {
  return take_turn([&] { return contender.render(frame); });
}

Timing take_turn(const std::function<Timing()>& render) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds least(20);
  const Clock::time_point begun = Clock::now();
  Timing last;
  do {
    last = render();
  } while (Clock::now() - begun < least);
  return last;
}

}  // namespace trisect::bench
