// The options of `trisect bench`.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "app/bench/options.h"

namespace trisect::bench {

class CommandLine {
 public:
  // Adds the command and its subcommands; they write into this object when the app parses.
  explicit CommandLine(CLI::App& app);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  CommandLine(CommandLine&&) = delete;
  CommandLine& operator=(CommandLine&&) = delete;
  ~CommandLine() = default;

  // Runs the subcommand that was parsed and returns its exit code. Throws UsageError for malformed
  // values.
  int run();

 private:
  // Values of options as CLI11 hands them over; nothing if an option is not given.
  struct Text {
    std::optional<std::string> size;
    std::optional<std::string> surface;
    std::optional<uint32_t> runs;
  };

  // Adds the options whose values go into `text_`.
  void add_frames(CLI::App& command, const MeasuredModels& defaults);
  void add_runs(CLI::App& command, uint32_t standard);
  void add_speed();
  void add_pareto();
  void add_ablation();
  void add_shape();
  void add_stability();
  void add_terminator();

  CLI::App& bench_;
  BenchOptions speed_;
  ParetoOptions pareto_;
  AblationOptions ablation_;
  ShapeOptions shape_;
  StabilityOptions stability_;
  TerminatorOptions terminator_;
  Text text_;  // of all but stability
  bool quick_ = false;
};

}  // namespace trisect::bench
