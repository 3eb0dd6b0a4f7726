#include "app/cli/interrupt.h"

#include <csignal>

namespace trisect {
namespace {

volatile std::sig_atomic_t signalled = 0;

void on_signal(int /*number*/) {
  signalled = 1;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int number : {SIGINT, SIGTERM}) {
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
