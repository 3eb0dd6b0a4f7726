// A hundred signals for each command, from its first moment to its last.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
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
constexpr int kSignals = 100;
// One second by alarm() (app/cli/interrupt.h), and as much for a busy machine.
constexpr int kMostMs = 2000;

struct SignalledCommand {
  std::vector<std::string> words;    // FOLDER/ at the beginning of one is the run's own folder
  std::vector<std::string> outputs;  // their names in FOLDER
};

std::vector<std::string> in_folder(const std::vector<std::string>& words, const fs::path& folder) {
  const std::string prefix = "FOLDER/";
  std::vector<std::string> placed;
  placed.reserve(words.size());
  for (const std::string& word : words) {
    placed.push_back(word.starts_with(prefix) ? (folder / word.substr(prefix.size())).string()
                                              : word);
  }
  return placed;
}

bool is_whole_output(const fs::path& file, const std::string& content) {
  if (file.extension() == ".json") return nlohmann::json::accept(content);
  if (file.extension() == ".png") return content.ends_with(std::string("IEND\xae\x42\x60\x82"));
  return !content.empty();
}

// Returns how often it was interrupted; what ends in a few milliseconds hardly ever is.
int expect_told_or_done(const SignalledCommand& command) {
  SCOPED_TRACE(fmt::format("{}", fmt::join(command.words, " ")));
  const test::TemporaryFolder cache;
  const std::vector<std::string> environment{"XDG_CACHE_HOME=" + cache.path().string()};
  // The second of two runs has everything in its cache.
  int whole_ms = 0;
  for (int i = 0; i < 2; ++i) {
    const test::TemporaryFolder folder;
    const auto begin = std::chrono::steady_clock::now();
    const test::ProgramRun run =
        test::run_trisect(in_folder(command.words, folder.path()), environment);
    EXPECT_LE(run.exit_code, exit_different) << run.err;
    whole_ms = static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(
                                    std::chrono::steady_clock::now() - begin)
                                    .count());
  }
  constexpr std::array<int, 4> numbers{SIGTERM, SIGINT, SIGHUP, SIGQUIT};
  int told = 0;
  int longest_ms = 0;
  for (int i = 0; i < kSignals; ++i) {
    const test::TemporaryFolder folder;
    for (const std::string& name : command.outputs) std::ofstream(folder / name) << kBefore;
    const int number = numbers.at(static_cast<std::size_t>(i) % numbers.size());
    const int after_ms = whole_ms * i / kSignals;
    const test::ProgramRun run = test::signal_trisect(in_folder(command.words, folder.path()),
                                                      after_ms, number, environment);
    SCOPED_TRACE(fmt::format("signal {} after {} of {} ms: exit code {} after {} ms, '{}'", number,
                             after_ms, whole_ms, run.exit_code, run.ms_after_signal, run.err));
    if (run.exit_code == 128 + number && run.err.empty()) {
      // Libraries are still being loaded: main() has not begun.
      EXPECT_LT(after_ms, 500);
    } else if (run.exit_code == exit_interrupted) {
      EXPECT_TRUE(run.err.ends_with("trisect: interrupted\n"));
      ++told;
    } else {
      EXPECT_LE(run.exit_code, exit_different);
    }
    EXPECT_LT(run.ms_after_signal, kMostMs);
    longest_ms = std::max(longest_ms, run.ms_after_signal);
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      if (!entry.is_regular_file()) continue;
      ++files;
      const std::string content = test::content_of(entry.path());
      EXPECT_TRUE(content == kBefore || is_whole_output(entry.path(), content)) << entry.path();
    }
    EXPECT_EQ(files, command.outputs.size());
  }
  std::cout << fmt::format("{}: {} of {} interrupted, after {} ms at most; {} ms without\n",
                           command.words.front(), told, kSignals, longest_ms, whole_ms)
            << std::flush;
  return told;
}

TEST(Signals, EndEveryCommandInOrder) {
  const std::string cube = test::asset_path("cube");
  const std::string teapot = test::asset_path("teapot");
  const test::TemporaryFolder pictures;
  std::vector<std::string> parts;
  for (const char* part : {"0,0,1600,600", "0,600,1600,600"}) {
    parts.push_back(pictures / fmt::format("{}.png", parts.size()));
    const test::ProgramRun run = test::run_trisect({"render", cube, "--size", "1600x1200", "--tile",
                                                    part, "--backend", "cpu", "-o", parts.back()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  int told = 0;
  for (const SignalledCommand& command : std::vector<SignalledCommand>{
           {{"render", teapot, "--size", "320x240", "--stats", "FOLDER/s.json", "-o",
             "FOLDER/a.png"},
            {"s.json", "a.png"}},
           {{"render", teapot, "--size", "320x240", "--backend", "opengl", "-o", "FOLDER/a.exr"},
            {"a.exr"}},
           {{"render", teapot, "--size", "320x240", "--backend", "cpu", "-o", "FOLDER/a.pfm"},
            {"a.pfm"}},
           {{"render", cube, "--size", "64x48", "--backend", "oracle", "-o", "FOLDER/a.png"},
            {"a.png"}},
           {{"render", cube, "--size", "320x240", "--turntable", "4", "-o", "FOLDER/{frame}.png"},
            {"0000.png", "0001.png", "0002.png", "0003.png"}},
           {{"export", teapot, "--error", "0.01", "-o", "FOLDER/a.glb", "--json", "FOLDER/e.json"},
            {"a.glb", "e.json"}},
           {{"info", teapot, "--json", "FOLDER/i.json"}, {"i.json"}},
           {{"stitch", parts[0], parts[1], "-o", "FOLDER/a.png"}, {"a.png"}},
           {{"compare", parts[0], parts[0], "--diff", "FOLDER/d.png", "--json", "FOLDER/c.json"},
            {"d.png", "c.json"}},
           {{"devices", "--json", "FOLDER/d.json"}, {"d.json"}},
           {{"crosscheck", cube, "--size", "32x24", "--json", "FOLDER/c.json"}, {"c.json"}},
           {{"accuracy", cube, "--size", "32x24", "--json", "FOLDER/a.json"}, {"a.json"}},
           {{"bench", "speed", cube, "--size", "64x48", "--runs", "1", "--surface", "phong",
             "--error", "1e-2", "--json", "FOLDER/b.json"},
            {"b.json"}}}) {
    told += expect_told_or_done(command);
  }
  EXPECT_GT(told, 500);
}

}  // namespace
}  // namespace trisect
