// The command line of the whole program.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace trisect {

class CommandLine {
 public:
  struct Command {
    const CLI::App* parsed;    // belongs to the app
    std::function<int()> run;  // to be called after it was parsed; returns the exit code
    // If set, to be called with the words before they are parsed.
    std::function<void(const std::vector<std::string>&)> before = {};
  };

  CommandLine();

  // All commands with their options and help. Not to be parsed.
  [[nodiscard]] const CLI::App& app() const { return app_; }

  // Parses the arguments and runs the command that they name. Prints what --help and --version ask
  // for. Returns an exit code; throws UsageError for arguments that cannot be.
  int run(int argc, const char* const* argv);

  // Does of it but the running. Returns whether there is a command to run.
  bool parse(int argc, const char* const* argv);

 private:
  CLI::App app_;
  std::vector<Command> commands_;
};

}  // namespace trisect
