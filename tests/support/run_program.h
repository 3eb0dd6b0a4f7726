// Runs the trisect program as a user does.
#pragma once

#include <string>
#include <vector>

namespace trisect::test {

struct ProgramRun {
  int exit_code = -1;  // 128 + the signal's number if a signal ended it
  std::string out;
  std::string err;
};

// environment: entries "NAME=value" that add to this process's or replace them.
ProgramRun run_trisect(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& environment = {});

// The environment under which a program's calls of Vulkan go through a layer of tests/layer.
std::vector<std::string> layer_environment(const std::string& layer);

// Starts it, sends it SIGINT after so many milliseconds, and waits.
ProgramRun interrupt_trisect(const std::vector<std::string>& arguments, int after_ms);

}  // namespace trisect::test
