// What --help prints.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "app/program/command_page.h"

namespace trisect {

// The fewest columns that help is written for.
inline constexpr std::size_t kNarrowest = 40;

// Columns to write help in: those that COLUMNS names, else the terminal's if standard output is
// one, else 80. At least kNarrowest, and at most 120, since longer lines are hard to read.
std::size_t help_width();

// The text in lines of at most `width` characters, broken at spaces. A word that is longer has a
// line of its own.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

// The help of a command, no line wider than `width`, which is at least kNarrowest.
std::string help_text(const CommandPage& page, std::size_t width);

// help_text() for CLI11, as wide as help_width().
class HelpFormat : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

}  // namespace trisect
