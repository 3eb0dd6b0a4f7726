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

  // Does what was parsed; returns an exit code. Throws UsageError for options that make no sense.
  int run();

 private:
  // Options that CLI11 hands over as text, or whose absence means something.
  struct Text {
    std::optional<std::string> size;
    std::optional<std::string> surface;
    std::optional<uint32_t> runs;
  };

  // The options of `text_`.
  void add_frames(CLI::App& command, const MeasuredModels& defaults);
  void add_speed();
  void add_pareto();
  void add_ablation();
  void add_stability();

  CLI::App& bench_;
  BenchOptions speed_;
  ParetoOptions pareto_;
  AblationOptions ablation_;
  StabilityOptions stability_;
  Text text_;  // of speed, pareto or ablation
  bool quick_ = false;
};

}  // namespace trisect::bench
