// A hundred signals for each command, from its first moment to its last.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "tests/support/command_in_folder.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

using test::CommandInFolder;

constexpr int kSignals = 100;
// 0.8 s by a timer (app/cli/interrupt.h), and more for a busy machine.
constexpr int kMostMs = 2000;

bool is_whole_output(const fs::path& file, const std::string& content) {
  if (file.extension() == ".json") return nlohmann::json::accept(content);
  if (file.extension() == ".png") return content.ends_with(std::string("IEND\xae\x42\x60\x82"));
  return !content.empty();
}

// Returns how often it was interrupted; what ends in a few milliseconds hardly ever is.
int expect_told_or_done(const CommandInFolder& command) {
  SCOPED_TRACE(fmt::format("{}", fmt::join(command.words, " ")));
  const test::TemporaryFolder cache;
  const std::vector<std::string> environment{"XDG_CACHE_HOME=" + cache.path().string()};
  // The second of two runs has everything in its cache.
  int whole_ms = 0;
  for (int i = 0; i < 2; ++i) {
    const test::TemporaryFolder folder;
    const test::ProgramRun run =
        test::run_trisect(test::in_folder(command.words, folder.path()), environment);
    EXPECT_LE(run.exit_code, exit_different) << run.err;
    whole_ms = run.ms;
  }
  constexpr std::array<int, 4> numbers{SIGTERM, SIGINT, SIGHUP, SIGQUIT};
  int told = 0;
  int longest_ms = 0;
  for (int i = 0; i < kSignals; ++i) {
    const test::TemporaryFolder folder;
    test::prepare_outputs(command, folder.path());
    const int number = numbers.at(static_cast<std::size_t>(i) % numbers.size());
    const int after_ms = whole_ms * i / kSignals;
    const test::ProgramRun run = test::signal_trisect(test::in_folder(command.words, folder.path()),
                                                      after_ms, number, environment);
    SCOPED_TRACE(fmt::format("signal {} after {} of {} ms: exit code {} after {} ms, '{}'", number,
                             after_ms, whole_ms, run.exit_code, run.ms, run.err));
    if (run.exit_code == 128 + number && run.err.empty()) {
      // Libraries are still being loaded: main() has not begun.
      EXPECT_LT(after_ms, 500);
    } else if (run.exit_code == exit_interrupted) {
      EXPECT_TRUE(run.err.ends_with("trisect: interrupted\n"));
      ++told;
    } else {
      EXPECT_LE(run.exit_code, exit_different);
    }
    EXPECT_LT(run.ms, kMostMs);
    longest_ms = std::max(longest_ms, run.ms);
    const std::map<std::string, std::string> files = test::files_in(folder.path());
    EXPECT_EQ(files.size(), command.outputs.size());
    for (const auto& [name, content] : files) {
      EXPECT_TRUE(content == test::kBefore || is_whole_output(name, content)) << name;
    }
  }
  std::cout << fmt::format("{}: {} of {} interrupted, after {} ms at most; {} ms without\n",
                           command.words.front(), told, kSignals, longest_ms, whole_ms)
            << std::flush;
  return told;
}

TEST(Signals, EndEveryCommandInOrder) {
  const std::string cube = test::asset_path("cube");
  const std::string teapot = test::asset_path("teapot");
  const test::TwoParts parts(1400);
  const test::RayLists lists("torus", 100);
  int told = 0;
  for (const CommandInFolder& command : std::vector<CommandInFolder>{
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
           parts.stitched(),
           parts.compared(),
           {{"devices", "--json", "FOLDER/d.json"}, {"d.json"}},
           {{"crosscheck", cube, "--size", "32x24", "--json", "FOLDER/c.json"}, {"c.json"}},
           {{"accuracy", cube, "--size", "32x24", "--json", "FOLDER/a.json"}, {"a.json"}},
           {{"certify", cube, "--size", "64x48", "-o", "FOLDER/y.png", "--json", "FOLDER/y.json"},
            {"y.png", "y.json"}},
           {{"bench", "speed", cube, "--size", "64x48", "--runs", "1", "--surface", "phong",
             "--error", "1e-2", "--json", "FOLDER/b.json"},
            {"b.json"}},
           {{"rays", teapot, "--count", "20000", "-o", "FOLDER/a.csv"}, {"a.csv"}},
           lists.cast(),
           lists.judged()}) {
    told += expect_told_or_done(command);
  }
  EXPECT_GT(told, 500);
}

}  // namespace
}  // namespace trisect
