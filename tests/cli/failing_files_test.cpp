// Commands whose calls for files fail, one in each run, by strace: a full disk, a disk that breaks,
// and no memory. Each is told by one sentence and the right exit code, or did no harm; what was
// there before is there still, and nothing else.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "tests/support/file_content.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBefore = "what was there before";

struct Command {
  std::vector<std::string> words;    // FOLDER/ at the beginning of one is the run's own folder
  std::vector<std::string> outputs;  // their names in FOLDER
};

struct Run {
  test::ProgramRun program;
  std::vector<std::string> calls;            // the first thread's
  std::map<std::string, std::string> files;  // what is in FOLDER after it
};

// calls: of the kernel, with commas. inject: what strace is to do with them, or empty.
Run run(const Command& command, const std::string& calls, const std::string& inject) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  fs::create_directory(out);
  for (const std::string& name : command.outputs) std::ofstream(out / name) << kBefore;
  const fs::path log = folder / "log";
  std::vector<std::string> words{"strace", "-f", "--seccomp-bpf", "-qq", "-o",
                                 log,      "-e", "trace=" + calls};
  if (!inject.empty()) words.insert(words.end(), {"-e", "inject=" + inject});
  words.push_back(test::program_path());
  for (const std::string& word : command.words) {
    const std::string prefix = "FOLDER/";
    words.push_back(word.starts_with(prefix) ? (out / word.substr(prefix.size())).string() : word);
  }
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
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    if (!entry.is_regular_file()) continue;
    result.files[fs::relative(entry.path(), out)] = test::content_of(entry.path());
  }
  return result;
}

bool is_whole(const std::string& name, const std::string& content, const Run& good) {
  // Times are different in every run.
  if (fs::path(name).extension() == ".json") return nlohmann::json::accept(content);
  return content == good.files.at(name);
}

// Makes each of these calls fail once; adds to runs how many there were.
void expect_each_told(const Command& command, const std::string& calls, const std::string& error,
                      int& runs) {
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
      EXPECT_TRUE(content == kBefore || is_whole(name, content, good)) << name;
    }
  }
}

std::vector<Command> commands() {
  const std::string cube = test::asset_path("cube");
  std::vector<Command> all;
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
  return all;
}

// Pictures in a folder that they lie in as long as it does.
class Pictures {
 public:
  Pictures() {
    for (const char* part : {"0,0,32,16", "0,16,32,16"}) {
      names_.push_back(folder_ / fmt::format("{}.png", names_.size()));
      const test::ProgramRun run =
          test::run_trisect({"render", test::asset_path("cube"), "--size", "32x32", "--tile", part,
                             "--backend", "cpu", "-o", names_.back()});
      EXPECT_EQ(run.exit_code, 0) << run.err;
    }
  }

  [[nodiscard]] Command stitched() const {
    return {{"stitch", names_[0], names_[1], "-o", "FOLDER/a.png"}, {"a.png"}};
  }
  [[nodiscard]] Command compared() const {
    return {{"compare", names_[0], names_[0], "--diff", "FOLDER/d.png", "--json", "FOLDER/c.json"},
            {"d.png", "c.json"}};
  }

 private:
  test::TemporaryFolder folder_;
  std::vector<std::string> names_;
};

TEST(FailingFiles, AreToldWhicheverWriteItIs) {
  const Pictures pictures;
  std::vector<Command> all = commands();
  all.push_back(pictures.stitched());
  all.push_back(pictures.compared());
  int runs = 0;
  for (const Command& command : all) expect_each_told(command, "write,writev", "ENOSPC", runs);
  RecordProperty("runs", runs);
}

TEST(FailingFiles, AreToldWhicheverNameItIs) {
  const Pictures pictures;
  std::vector<Command> all = commands();
  all.push_back(pictures.stitched());
  all.push_back(pictures.compared());
  int runs = 0;
  for (const Command& command : all) {
    if (!command.outputs.empty()) expect_each_told(command, "rename,linkat", "EIO", runs);
  }
  RecordProperty("runs", runs);
}

}  // namespace
}  // namespace trisect
