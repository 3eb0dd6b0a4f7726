// The options of `trisect view`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/cli/scene_options.h"
#include "app/view/options.h"

namespace trisect::view {

class CommandLine {
 public:
  // Adds the command; it writes into this object when the app parses.
  explicit CommandLine(CLI::App& app);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  CommandLine(CommandLine&&) = delete;
  CommandLine& operator=(CommandLine&&) = delete;
  ~CommandLine() = default;

  // Does what was parsed; returns an exit code. Throws UsageError for options that make no sense.
  int run();

 private:
  ViewOptions options_;
  SceneText text_;
  uint64_t frames_ = 0;
};

}  // namespace trisect::view
