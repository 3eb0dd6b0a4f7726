// Commands whose calls for files fail, one in each run, by strace: a full disk, and one that
// breaks. Each is told by one sentence and the right exit code, and every output is whole or what
// was there before.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "tests/support/command_in_folder.h"
#include "tests/support/file_content.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

using test::CommandInFolder;

struct Run {
  test::ProgramRun program;
  std::vector<std::string> calls;            // the first thread's
  std::map<std::string, std::string> files;  // what is in FOLDER after it
};

// calls: of the kernel, with commas. inject: what strace is to do with them, or empty.
Run run(const CommandInFolder& command, const std::string& calls, const std::string& inject) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  fs::create_directory(out);
  test::prepare_outputs(command, out);
  const fs::path log = folder / "log";
  std::vector<std::string> words{"strace", "-f", "--seccomp-bpf", "-qq", "-o",
                                 log,      "-e", "trace=" + calls};
  if (!inject.empty()) words.insert(words.end(), {"-e", "inject=" + inject});
  words.push_back(test::program_path());
  const std::vector<std::string> placed = test::in_folder(command.words, out);
  words.insert(words.end(), placed.begin(), placed.end());
  Run result;
  // Sanitizers cannot look for leaks in a program that is traced.
  result.program = test::run_program(
      words, {"XDG_CACHE_HOME=" + (folder / "cache").string(), "ASAN_OPTIONS=detect_leaks=0"}, 120);
  std::istringstream lines(test::content_of(log));
  std::string first_thread;
  for (std::string line; std::getline(lines, line);) {
    const std::string thread = line.substr(0, line.find(' '));
    if (first_thread.empty()) first_thread = thread;
    if (thread == first_thread && line.find("resumed>") == std::string::npos) {
      result.calls.push_back(line.substr(line.find_first_not_of(' ', thread.size())));
    }
  }
  result.files = test::files_in(out);
  return result;
}

bool is_whole(const std::string& name, const std::string& content, const Run& good) {
  // Times are different in every run.
  if (fs::path(name).extension() == ".json") return nlohmann::json::accept(content);
  return content == good.files.at(name);
}

// Makes each of these calls fail once; adds to runs how many there were.
void expect_each_told(const CommandInFolder& command, const std::string& calls,
                      const std::string& error, int& runs) {
  const Run good = run(command, calls, "");
  SCOPED_TRACE(fmt::format("{}", fmt::join(command.words, " ")));
  ASSERT_EQ(good.program.exit_code, 0) << good.program.err;
  ASSERT_FALSE(good.calls.empty());
  std::map<std::string, int> numbers;
  for (const std::string& call : good.calls) {
    const std::string function = call.substr(0, call.find('('));
    const int number = ++numbers[function];
    // Who cannot be told cannot be told that.
    if (call.starts_with("write(2,")) continue;
    const Run faulty =
        run(command, calls, fmt::format("{}:error={}:when={}", function, error, number));
    ++runs;
    const std::string& err = faulty.program.err;
    SCOPED_TRACE(fmt::format("{}, {}: exit code {}, '{}'", call.substr(0, 100), error,
                             faulty.program.exit_code, err));
    EXPECT_EQ(faulty.program.exit_code, exit_bad_input);
    const std::size_t told = err.find("trisect: ");
    ASSERT_NE(told, std::string::npos);
    EXPECT_EQ(err.find('\n', told), err.size() - 1);
    EXPECT_EQ(faulty.files.size(), command.outputs.size());
    for (const auto& [name, content] : faulty.files) {
      EXPECT_TRUE(content == test::kBefore || is_whole(name, content, good)) << name;
    }
  }
}

// For those that read pictures and lists of rays.
std::vector<CommandInFolder> commands(const test::TwoParts& parts, const test::RayLists& lists) {
  const std::string cube = test::asset_path("cube");
  std::vector<CommandInFolder> all;
  for (const char* name : {"a.png", "a.exr", "a.pfm"}) {
    all.push_back({{"render", cube, "--size", "48x32", "--backend", "cpu", "--stats",
                    "FOLDER/s.json", "-o", std::string("FOLDER/") + name},
                   {name, "s.json"}});
  }
  all.push_back({{"render", cube, "--size", "16x16", "--backend", "cpu", "-o", "-"}, {}});
  all.push_back({{"render", cube, "--size", "16x16", "--backend", "cpu", "--turntable", "2", "-o",
                  "FOLDER/{frame}.png"},
                 {"0000.png", "0001.png"}});
  for (const char* name : {"a.obj", "a.ply", "a.stl", "a.glb"}) {
    all.push_back({{"export", cube, "--subdivide", "8", "--json", "FOLDER/e.json", "-o",
                    std::string("FOLDER/") + name},
                   {name, "e.json"}});
  }
  all.push_back({{"info", cube, "--json", "FOLDER/i.json"}, {"i.json"}});
  all.push_back(parts.stitched());
  all.push_back(parts.compared());
  all.push_back({{"rays", cube, "--count", "100", "-o", "FOLDER/a.rays"}, {"a.rays"}});
  all.push_back(lists.cast());
  all.push_back(lists.judged());
  return all;
}

TEST(FailingFiles, AreToldWhicheverWriteItIs) {
  const test::TwoParts parts(32);
  const test::RayLists lists("cube", 4);
  int runs = 0;
  for (const CommandInFolder& command : commands(parts, lists)) {
    expect_each_told(command, "write,writev", "ENOSPC", runs);
  }
  RecordProperty("runs", runs);
}

TEST(FailingFiles, AreToldWhicheverNameItIs) {
  const test::TwoParts parts(32);
  const test::RayLists lists("cube", 4);
  int runs = 0;
  for (const CommandInFolder& command : commands(parts, lists)) {
    if (!command.outputs.empty()) expect_each_told(command, "rename,linkat", "EIO", runs);
  }
  RecordProperty("runs", runs);
}

}  // namespace
}  // namespace trisect
