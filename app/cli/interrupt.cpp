#include "app/cli/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <cstring>
#include <ctime>
#include <exception>
#include <new>
#include <optional>

#include "app/base/error.h"
#include "app/base/temporary_names.h"

namespace trisect {
namespace {

volatile std::sig_atomic_t signalled = 0;
bool is_on_terminal = false;

// Brings SIGALRM; nothing if the system has no more of them.
std::optional<timer_t> timer;
// So that the program is gone within a second, as it promises.
constexpr long kPatienceMs = 800;

// 0: never.
void bring_alarm_after(long ms) {
  const itimerspec once{{0, 0}, {0, ms * 1'000'000}};
  if (timer) {
    timer_settime(*timer, 0, &once, nullptr);
  } else {
    alarm(ms > 0 ? 1 : 0);
  }
}

// The handlers call only what is safe in them.

void on_signal(int /*number*/) {
  // Who ends a group of processes may signal twice, as timeout does.
  if (signalled == 0) bring_alarm_after(kPatienceMs);
  signalled = 1;
}

void on_alarm(int /*number*/) {
  end_at_once(exit_interrupted, "interrupted");
}

}  // namespace

void catch_interrupts() {
  is_on_terminal = isatty(STDERR_FILENO) != 0;
  timer_t made{};
  if (timer_create(CLOCK_MONOTONIC, nullptr, &made) == 0) timer = made;
  struct sigaction action {};
  action.sa_handler = on_alarm;
  sigaction(SIGALRM, &action, nullptr);
  action.sa_handler = on_signal;
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    struct sigaction inherited {};
    sigaction(number, nullptr, &inherited);
    // Whoever started the program with the signal ignored (nohup) wants it ignored.
    if (inherited.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
}

void tell_what_nothing_catches() {
  std::set_terminate([] {
    try {
      if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
      end_at_once(exit_out_of_memory, kNoMemory);
    } catch (...) {  // of which no more is told than that it was
    }
    end_at_once(exit_internal, "internal error: an exception that nothing catches.");
  });
}

void ends_in_order() {
  bring_alarm_after(0);
}

void end_at_once(int code, const char* message) {
  remove_temporary_files();
  const auto print = [](const char* text) {
    [[maybe_unused]] const ssize_t unused = write(STDERR_FILENO, text, std::strlen(text));
  };
  // There may be a line of progress.
  if (is_on_terminal) print("\r\033[K");
  print("trisect: ");
  print(message);
  print("\n");
  _exit(code);
}

bool not_interrupted() {
  return signalled == 0;
}

void stop_if_interrupted() {
  if (!not_interrupted()) throw Interrupted();
}

}  // namespace trisect
