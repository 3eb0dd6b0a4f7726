// The options of `trisect view`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/cli/scene_options.h"
#include "app/view/options.h"

namespace trisect::view {

class CommandLine {
 public:
  // Adds the command to the app, which must not outlive this object: parsing writes into it.
  explicit CommandLine(CLI::App& app);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  CommandLine(CommandLine&&) = delete;
  CommandLine& operator=(CommandLine&&) = delete;
  ~CommandLine() = default;

  // Runs the command with the parsed options; returns an exit code. Throws UsageError for options
  // that do not go together.
  int run();

 private:
  ViewOptions options_;
  SceneText text_;
  uint64_t frames_ = 0;
};

}  // namespace trisect::view
