// Completions know every option, and bash completes by them.
#include "app/program/completions.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/program/command_line.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

using Words = std::set<std::string>;

CommandPage completed_program() {
  return command_page(CommandLine().app());
}

// What a shell's command prints, line by line.
Words lines_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string output;
  std::array<char, 4096> part{};
  while (std::fgets(part.data(), static_cast<int>(part.size()), pipe) != nullptr) {
    output += part.data();
  }
  EXPECT_EQ(pclose(pipe), 0) << command;
  Words lines;
  std::istringstream text(output);
  for (std::string line; std::getline(text, line);) lines.insert(line);
  return lines;
}

class Completions : public ::testing::Test {
 protected:
  Completions() {
    std::ofstream(folder_ / "trisect") << bash_completions(completed_program());
    for (const char* name : {"a.obj", "b.GLB", "c.stl.gz", "d.txt", "e f.ply", "g.png", "h.json"}) {
      std::ofstream(folder_ / name) << "";
    }
    std::filesystem::create_directory(folder_ / "models");
  }

  // What bash offers for the last of the words, in a folder with the files above.
  Words offered(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += " '" + word + "'";
    std::ofstream(folder_ / "ask.sh")
        << ". ./trisect\nCOMP_WORDS=(trisect" << line << ")\nCOMP_CWORD=" << words.size()
        << "\n_trisect\nif [ ${#COMPREPLY[@]} -gt 0 ]; then printf '%s\\n' \"${COMPREPLY[@]}\"; "
           "fi\n";
    return lines_of(fmt::format("cd '{}' && bash --norc ask.sh 2>&1", folder_.path().string()));
  }

  test::TemporaryFolder folder_;
};

TEST_F(Completions, NameEveryOptionOfEveryCommand) {
  const CommandPage program = completed_program();
  const std::string zsh = zsh_completions(program);
  const std::string fish = fish_completions(program);
  for (const CommandPage* page : all_pages(program)) {
    std::vector<std::string> words;
    std::istringstream path(page->path);
    for (std::string word; path >> word;) words.push_back(word);
    words.erase(words.begin());
    words.emplace_back("-");
    const Words in_bash = offered(words);
    words.pop_back();
    std::string name = "_trisect";
    for (const std::string& word : words) name += '_' + word;
    const std::size_t begin = zsh.find('\n' + name + "() {\n");
    ASSERT_NE(begin, std::string::npos) << name;
    const std::string in_zsh = zsh.substr(begin, zsh.find("\n}\n", begin) - begin);
    const std::string when =
        fmt::format("{}{}' ", page->commands.empty() ? "__trisect_within " : "__trisect_just_after",
                    fmt::format("{}{}", page->commands.empty() || words.empty() ? "" : " ",
                                fmt::join(words, " ")));
    for (const OptionPage& option : page->options) {
      if (option.is_argument) continue;
      for (const std::string& spelled : option.names) {
        const std::string what = page->path + ' ' + spelled;
        EXPECT_EQ(in_bash.count(spelled), 1U) << what;
        EXPECT_TRUE(in_zsh.find(')' + spelled + (option.value.empty() ? "[" : "")) !=
                        std::string::npos ||
                    in_zsh.find("'*" + spelled) != std::string::npos)
            << what;
        const std::string flag =
            spelled.starts_with("--") ? " -l " + spelled.substr(2) : " -s " + spelled.substr(1);
        bool is_in_fish = false;
        std::istringstream text(fish);
        for (std::string line; std::getline(text, line);) {
          is_in_fish = is_in_fish || (line.find(when) != std::string::npos &&
                                      (line + ' ').find(flag + ' ') != std::string::npos);
        }
        EXPECT_TRUE(is_in_fish) << what << " after " << when;
      }
    }
  }
}

TEST_F(Completions, OfBashCompleteCommandsAndOptions) {
  EXPECT_EQ(offered({"re"}), Words{"render"});
  EXPECT_EQ(offered({"bench", "s"}), (Words{"shape", "speed", "stability"}));
  EXPECT_EQ(offered({"render", "--sur"}), Words{"--surface"});
  EXPECT_EQ(offered({"bench", "pareto", "--no"}), (Words{"--no-opengl", "--no-plots"}));
  EXPECT_EQ(offered({"nonsense", "--"}), Words{});
}

TEST_F(Completions, OfBashCompleteValues) {
  EXPECT_EQ(offered({"render", "--surface", ""}), (Words{"flat", "phong", "sphere"}));
  EXPECT_EQ(offered({"render", "a.obj", "--surface", "s"}), Words{"sphere"});
  EXPECT_EQ(offered({"render", "--surface", "="}), (Words{"flat", "phong", "sphere"}));
  EXPECT_EQ(offered({"render", "--surface", "=", "ph"}), Words{"phong"});
  EXPECT_EQ(offered({"info", "--surface", ""}), (Words{"phong", "sphere"}));
  EXPECT_EQ(offered({"render", "--spp", ""}), (Words{"1", "4", "9", "16"}));
  EXPECT_EQ(offered({"render", "--background", "t"}), Words{"transparent"});
  EXPECT_EQ(offered({"render", "--eye", ""}), Words{});
}

TEST_F(Completions, OfBashCompleteFiles) {
  EXPECT_EQ(offered({"render", ""}), (Words{"a.obj", "b.GLB", "c.stl.gz", "e f.ply", "models"}));
  EXPECT_EQ(offered({"render", "a.obj", "-o", ""}), (Words{"g.png", "models"}));
  EXPECT_EQ(offered({"render", "a.obj", "--stats", "h"}), Words{"h.json"});
  EXPECT_EQ(offered({"view", "--script", "d"}), Words{"d.txt"});
  EXPECT_EQ(offered({"bench", "pareto", "a.obj", "-o", ""}), Words{"models"});
}

TEST_F(Completions, OfBashAreWrittenRight) {
  EXPECT_EQ(lines_of(fmt::format("bash -n '{}' 2>&1", (folder_ / "trisect").string())), Words{});
}

}  // namespace
}  // namespace trisect
