// What --help says: all of it, in groups, and no wider than asked.
#include "app/program/help_format.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/cli/option_groups.h"
#include "app/program/command_line.h"
#include "app/program/command_texts.h"

namespace trisect {
namespace {

CommandPage program_page() {
  return command_page(CommandLine().app());
}

TEST(Help, IsThereForEveryOptionInAGroup) {
  const CommandPage program = program_page();
  const std::set<std::string> known(option_group::kAll.begin(), option_group::kAll.end());
  std::size_t options = 0;
  for (const CommandPage* page : all_pages(program)) {
    EXPECT_NE(page->summary, "") << page->path;
    for (const OptionPage& option : page->options) {
      ++options;
      const std::string what = page->path + ' ' + option.names.front();
      EXPECT_NE(option.text, "") << what;
      EXPECT_EQ(known.count(option.group), 1U)
          << what << " is in a group '" << option.group << "', which option_groups.h does not have";
      EXPECT_EQ(option.value.find('{'), std::string::npos) << what << ' ' << option.value;
      EXPECT_NE(option.value, "TEXT") << what << " has no type_name()";
      EXPECT_NE(option.value, "FLOAT") << what << " has no type_name()";
      EXPECT_NE(option.value, "UINT") << what << " has no type_name()";
    }
  }
  EXPECT_GT(options, 100U);
}

// The same option is on the same subject in every command.
TEST(Help, HasAnOptionInTheSameGroupEverywhere) {
  const CommandPage program = program_page();
  std::map<std::string, std::string> groups;
  for (const CommandPage* page : all_pages(program)) {
    for (const OptionPage& option : page->options) {
      // trisect export's --error is the surface's, trisect bench speed's what is measured; --frames
      // of trisect render are some of a sequence, of trisect view all that the window shows.
      if (option.names.front() == "--error" || option.names.front() == "--frames") continue;
      const auto [known, is_new] = groups.emplace(option.names.back(), option.group);
      EXPECT_EQ(known->second, option.group) << page->path << ' ' << option.names.back();
    }
  }
}

TEST(Help, IsNoWiderThanAsked) {
  const CommandPage program = program_page();
  for (const CommandPage* page : all_pages(program)) {
    for (const std::size_t width : {40U, 59U, 60U, 80U, 120U}) {
      const std::string help = help_text(*page, width);
      std::istringstream text(help);
      std::size_t widest = 0;
      for (std::string line; std::getline(text, line);) {
        EXPECT_LE(line.size(), width) << page->path << ": " << line;
        EXPECT_FALSE(line.ends_with(' ')) << page->path << ": " << line;
        widest = std::max(widest, line.size());
      }
      // It takes the room that there is.
      if (page->path == "trisect render") {
        EXPECT_GT(widest, width * 4 / 5) << page->path;
      }
      for (const OptionPage& option : page->options) {
        EXPECT_NE(help.find(option.names.back()), std::string::npos)
            << page->path << ' ' << option.names.back();
      }
    }
  }
}

TEST(Help, ListsCommandsGroupsExamplesAndExitCodes) {
  const CommandPage program = program_page();
  const std::string help = help_text(program, 80);
  std::size_t last = help.find("\nCommands:\n");
  ASSERT_NE(last, std::string::npos) << help;
  for (const CommandPage& command : program.commands) {
    const std::size_t at = help.find("\n  " + command.name() + ' ');
    EXPECT_NE(at, std::string::npos) << command.name();
    EXPECT_GT(at, last) << command.name();
    last = at;
  }
  EXPECT_EQ(program.commands.front().path, "trisect render");
  for (const char* part :
       {"\nExamples:\n", "\nExit codes:\n", "\n  130  ", "\n  70   ", "\n  6    "}) {
    EXPECT_NE(help.find(part), std::string::npos) << part << help;
  }
  const std::string render = help_text(program.commands.front(), 80);
  last = 0;
  for (const char* part : {"Usage: trisect render [MODEL] -o FILE [OPTION]...\n", "\nModel:\n",
                           "\nSurface:\n", "\nCamera:\n", "\nPicture:\n",
                           "\nHow rays are traced:\n", "\nOutput:\n", "\nExamples:\n"}) {
    const std::size_t at = render.find(part);
    EXPECT_NE(at, std::string::npos) << part << render;
    EXPECT_GE(at, last) << part;
    last = at;
  }
  EXPECT_EQ(render.find("REQUIRED"), std::string::npos);
}

TEST(Help, SaysWhichOptionsOneOfMustBeGiven) {
  const CommandPage program = program_page();
  for (const CommandPage& command : program.commands) {
    if (command.name() != "export") continue;
    EXPECT_EQ(command.usage,
              "trisect export MODEL -o FILE (--subdivide N | --error EPS) [OPTION]...");
  }
}

// Two to four for every command, each a line that the command line takes.
TEST(Help, HasExamplesThatAreRight) {
  const CommandPage program = program_page();
  for (const CommandPage* page : all_pages(program)) {
    const std::vector<Example> examples = command_texts(page->path).examples;
    EXPECT_GE(examples.size(), 2U) << page->path;
    EXPECT_LE(examples.size(), 4U) << page->path;
    for (const Example& example : examples) {
      EXPECT_TRUE(example.line.starts_with(page->path + ' ') || example.line == page->path)
          << example.line;
      std::istringstream text(example.line);
      std::vector<std::string> words;
      for (std::string word; text >> word;) words.push_back(word);
      std::vector<const char*> arguments;
      arguments.reserve(words.size());
      for (const std::string& word : words) arguments.push_back(word.c_str());
      try {
        EXPECT_TRUE(CommandLine().parse(static_cast<int>(arguments.size()), arguments.data()));
      } catch (const UsageError& error) {
        ADD_FAILURE() << example.line << ": " << error.what();
      }
    }
  }
}

TEST(Help, IsAsWideAsColumnsSay) {
  const auto width_with = [](const char* columns) {
    setenv("COLUMNS", columns, 1);
    const std::size_t width = help_width();
    unsetenv("COLUMNS");
    return width;
  };
  EXPECT_EQ(width_with("72"), 72U);
  EXPECT_EQ(width_with("10"), kNarrowest);
  EXPECT_EQ(width_with("1000"), 120U);
}

TEST(Help, BreaksLinesAtSpaces) {
  EXPECT_EQ(wrapped("one two  three", 7), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrapped("incomparably so", 5), (std::vector<std::string>{"incomparably", "so"}));
  EXPECT_EQ(wrapped("", 5), std::vector<std::string>{});
}

}  // namespace
}  // namespace trisect
