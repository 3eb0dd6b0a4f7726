// Runs of the program in which calls of Vulkan fail, one in each run, by
// tests/layer/fault_layer.cpp.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/run_program.h"

namespace trisect::test {

struct Fault {
  std::string function;
  std::size_t call = 1;  // which one of the function's, from 1
  std::string result;    // "VK_ERROR_DEVICE_LOST", ...
};

// The exit code that the contract has for a result.
int exit_code_of(const std::string& result);

// One fault for each of these calls, in turns of every result; turn: where the turns begin.
std::vector<Fault> every_call(const std::vector<std::string>& calls, std::size_t turn = 0);
// The same for each function's first and last call.
std::vector<Fault> first_and_last_calls(const std::vector<std::string>& calls,
                                        std::size_t turn = 0);

// What came of a run.
struct FaultyRun {
  Fault fault;
  ProgramRun program;
  std::vector<std::string> files;  // names of what is in its folder
  std::string misuse;              // what the validation layer says of its calls
};

// A command of the program, to be run again and again. Its kernels are empty. `FOLDER/` at the
// beginning of an argument stands for a folder of the run's own.
class FailingCommand {
 public:
  explicit FailingCommand(std::vector<std::string> arguments,
                          std::vector<std::string> environment = {})
      : arguments_(std::move(arguments)), environment_(std::move(environment)) {}

  // The functions of the calls that can fail, in the order of a run in which none does. A test
  // failure if the run fails.
  [[nodiscard]] std::vector<std::string> calls() const;

  [[nodiscard]] FaultyRun run(const Fault& fault) const;

  // Runs it with each of the faults, two at a time.
  [[nodiscard]] std::vector<FaultyRun> run_all(const std::vector<Fault>& faults) const;

 private:
  [[nodiscard]] FaultyRun run_with(const std::string& variable) const;

  std::vector<std::string> arguments_;
  std::vector<std::string> environment_;
};

// Test failures unless the program ended with the fault's exit code and one sentence that names the
// result, left no file, and misused nothing of Vulkan.
void expect_told(const FaultyRun& run);

// Test failures unless the program went well in spite of the fault: exit code 0, no sentence, these
// files, nothing misused.
void expect_unimpressed(const FaultyRun& run, const std::vector<std::string>& files);

}  // namespace trisect::test
