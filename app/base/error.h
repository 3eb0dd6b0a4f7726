// The errors a user can cause, each one clear sentence, and the exit codes they end in.
#pragma once

#include <stdexcept>

namespace trisect {

enum ExitCode : int {
  exit_done = 0,
  exit_different = 1,  // from what was promised
  exit_usage = 2,
  exit_bad_input = 3,
  exit_no_device = 4,
  exit_internal = 70,  // a failed check of the program's own, as sysexits.h has it
  exit_interrupted = 130,
};

// The command line asks for something that is not there. The message names the option.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A file cannot be read or written, or holds nonsense. The message names the file and, where there
// is one, the line.
class InputError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The user pressed Ctrl-C.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace trisect
