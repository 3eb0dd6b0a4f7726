// Runs the trisect program as a user does.
#pragma once

#include <csignal>
#include <string>
#include <vector>

namespace trisect::test {

struct ProgramRun {
  int exit_code = -1;  // 128 + the signal's number if a signal ended it
  std::string out;
  std::string err;
  int ms = 0;  // to the end, from signal_trisect()'s signal or else from the start, in milliseconds
};

// The program, which lies beside the test.
std::string program_path();

// words: the program, by name or path, and its arguments. environment: entries "NAME=value" that
// add to this process's or replace them; of two of a name the last one. seconds_at_most: SIGKILL
// ends a program that takes longer; 0 for any time.
ProgramRun run_program(std::vector<std::string> words,
                       const std::vector<std::string>& environment = {}, int seconds_at_most = 0);

// The same with trisect for the program.
ProgramRun run_trisect(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& environment = {}, int seconds_at_most = 0);

// The environment under which a program's calls of Vulkan go through a layer of tests/layer.
std::vector<std::string> layer_environment(const std::string& layer);

// Starts it, sends it a signal after so many milliseconds, and waits. environment: as above.
ProgramRun signal_trisect(const std::vector<std::string>& arguments, int after_ms,
                          int signal = SIGINT, const std::vector<std::string>& environment = {});

}  // namespace trisect::test
