// What there is to say about a command, read from the tables of its options: help, manual and
// completions are three ways to write it down.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/cli/suggestions.h"

namespace trisect {

struct OptionPage {
  std::vector<std::string> names;  // "-o", "--output"; "MODEL" of an argument without a dash
  std::string value;               // what stands for it: "FILE"; empty for a flag
  std::string group;
  std::string text;
  bool is_argument = false;  // is told by its place, not by a name
  bool is_required = false;
  bool may_repeat = false;  // all of them count, not just the last one
  Suggestions suggestions;

  // "-o, --output FILE"
  [[nodiscard]] std::string heading() const;
};

struct CommandPage {
  std::string path;     // "trisect bench speed"
  std::string summary;  // one sentence without a full stop
  std::string usage;    // "trisect export MODEL -o FILE (--subdivide N | --error EPS) [OPTION]..."
  std::vector<OptionPage> options;
  std::vector<CommandPage> commands;

  // "speed"
  [[nodiscard]] std::string name() const;
};

CommandPage command_page(const CLI::App& app);

// The options by their groups, in the groups' order, then those of groups that option_group::kAll
// lacks. In a group arguments come first. No group is empty.
struct OptionGroup {
  std::string name;
  std::vector<const OptionPage*> options;  // of the page
};
std::vector<OptionGroup> option_groups(const CommandPage& page);

// The page and those of all commands below it.
std::vector<const CommandPage*> all_pages(const CommandPage& page);

}  // namespace trisect
