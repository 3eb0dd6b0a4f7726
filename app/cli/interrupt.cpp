#include "app/cli/interrupt.h"

#include <csignal>
#include <ctime>

namespace trisect {
namespace {

volatile std::sig_atomic_t signalled = 0;
timespec first_signal{};

// Calls only what is safe in a handler.
void on_signal(int number) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (signalled == 0) {
    first_signal = now;
    signalled = 1;
  } else if (now.tv_sec > first_signal.tv_sec + 1) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    struct sigaction inherited {};
    sigaction(number, nullptr, &inherited);
    // Whoever started the program with the signal ignored (nohup) wants it ignored.
    if (inherited.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
}

bool not_interrupted() {
  return signalled == 0;
}

void stop_if_interrupted() {
  if (!not_interrupted()) throw Interrupted();
}

}  // namespace trisect
