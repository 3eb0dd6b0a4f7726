// Ctrl-C and termination, noticed between two steps so that nothing is left half done.
#pragma once

#include <optional>
#include <stdexcept>
#include <utility>

#include "app/base/keep_going.h"

namespace trisect {

// The user pressed Ctrl-C: the program ends.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

// Installs the handlers: SIGINT, SIGTERM, SIGHUP or SIGQUIT is remembered, and if the program has
// not ended 0.8 s later, as it waits for a driver or a library, end_at_once() ends it. A file
// that becomes larger than allowed (SIGXFSZ) is an error of writing.
void catch_interrupts();

// Has an exception that nothing can catch end_at_once(): one that leaves a destructor, as that of a
// library's JSON which needs memory, or a thread.
void tell_what_nothing_catches();

// For an error that is about to be told: from here on the program ends by itself.
void ends_in_order();

// Ends the process with this exit code after a line on standard error, from any thread, also from a
// signal handler. Temporary files are removed, nothing else is cleaned up. message: "interrupted".
[[noreturn]] void end_at_once(int code, const char* message);

// True until a signal has come. Long steps of the library ask this to learn whether to go on.
bool not_interrupted();

// The same for steps that tell which part is done, which nobody sees.
inline FractionProgress until_interrupted() {
  return [](double) { return not_interrupted(); };
}

// Throws Interrupted if a signal has come.
void stop_if_interrupted();

// The result of a step that asked not_interrupted(). Throws Interrupted if there is none.
template <typename Result>
Result finished(std::optional<Result> result) {
  if (!result) throw Interrupted();
  return *std::move(result);
}

}  // namespace trisect
