#include "app/program/help_format.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "app/base/number_text.h"
#include "app/program/command_texts.h"

namespace trisect {
namespace {

constexpr std::size_t kWidest = 120;
// Narrower than this, what an option does stands below its name.
constexpr std::size_t kTwoColumns = 60;
constexpr std::size_t kIndent = 2;

std::size_t columns_wanted() {
  if (const char* text = std::getenv("COLUMNS"); text != nullptr) {
    const std::optional<std::size_t> columns = parse_number<std::size_t>(text);
    if (columns && *columns > 0) return *columns;
  }
  winsize size{};
  if (isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 &&
      size.ws_col > 0) {
    return size.ws_col;
  }
  return 80;
}

std::string spaces(std::size_t count) {
  return std::string(count, ' ');
}

// Lines of text below each other, each after so many spaces.
std::string indented(const std::string& text, std::size_t indent, std::size_t width) {
  std::string lines;
  for (const std::string& line : wrapped(text, width - indent)) {
    lines += spaces(indent) + line + '\n';
  }
  return lines;
}

// Names with what they stand for below a title.
struct Section {
  std::string title;
  std::vector<Term> terms;
};

// Where what terms stand for begins: right of all names but very long ones.
std::size_t text_column(const std::vector<Section>& sections, std::size_t width) {
  constexpr std::size_t kWidestName = 24;
  if (width < kTwoColumns) return 3 * kIndent;
  std::size_t name_width = 0;
  for (const Section& section : sections) {
    for (const Term& term : section.terms) {
      if (term.name.size() <= kWidestName) name_width = std::max(name_width, term.name.size());
    }
  }
  return kIndent + name_width + 2;
}

std::string section_text(const Section& section, std::size_t column, std::size_t width) {
  std::string lines = section.title + ":\n";
  for (const Term& term : section.terms) {
    const std::string name = spaces(kIndent) + term.name;
    std::string text = indented(term.text, column, width);
    // The first line of the text stands beside the name where there is room.
    if (width >= kTwoColumns && name.size() + 2 <= column) {
      text.replace(0, name.size(), name);
    } else {
      text.insert(0, indented(term.name, kIndent, width));
    }
    lines += text;
  }
  return lines;
}

std::vector<Section> sections_of(const CommandPage& page) {
  std::vector<Section> sections;
  if (!page.commands.empty()) sections.push_back({"Commands", {}});
  for (const CommandPage& command : page.commands) {
    sections.back().terms.push_back({command.name(), command.summary});
  }
  for (const OptionGroup& group : option_groups(page)) {
    sections.push_back({group.name, {}});
    for (const OptionPage* option : group.options) {
      sections.back().terms.push_back({option->heading(), option->text});
    }
  }
  return sections;
}

// A line to be typed, which goes on after a backslash where it is too long.
std::string typed(const std::string& line, std::size_t indent, std::size_t width) {
  std::vector<std::string> parts = wrapped(line, width - indent - 4);
  std::string lines;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    lines += spaces(indent + (i == 0 ? 0 : kIndent)) + parts[i];
    lines += i + 1 == parts.size() ? "\n" : " \\\n";
  }
  return lines;
}

}  // namespace

std::size_t help_width() {
  return std::clamp(columns_wanted(), kNarrowest, kWidest);
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::vector<std::string> lines;
  for (std::string word; words >> word;) {
    if (!lines.empty() && lines.back().size() + 1 + word.size() <= width) {
      lines.back() += ' ' + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

std::string help_text(const CommandPage& page, std::size_t width) {
  std::string help = indented(page.summary, 0, width) + '\n';
  const std::string usage = "Usage: ";
  std::string lines = indented(page.usage, usage.size(), width);
  help += lines.replace(0, usage.size(), usage);
  const std::vector<Section> sections = sections_of(page);
  const std::size_t column = text_column(sections, width);
  for (const Section& section : sections) help += '\n' + section_text(section, column, width);
  const std::vector<Example> examples = command_texts(page.path).examples;
  if (!examples.empty()) help += "\nExamples:\n";
  for (const Example& example : examples) {
    help += indented(example.what + ':', kIndent, width);
    help += typed(example.line, 2 * kIndent, width);
  }
  const bool is_program = page.path.find(' ') == std::string::npos;
  if (is_program) help += '\n' + section_text({"Exit codes", exit_codes()}, column, width);
  if (!page.commands.empty()) {
    help +=
        '\n' + indented(fmt::format("{} COMMAND --help has the options of a command.", page.path),
                        0, width);
  }
  return help;
}

std::string HelpFormat::make_help(const CLI::App* app, std::string /*name*/,
                                  CLI::AppFormatMode /*mode*/) const {
  return help_text(command_page(*app), help_width());
}

}  // namespace trisect
