// For tests of the program as a user runs it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/gpu.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect::test {

class Program : public ::testing::Test {
 protected:
  // `trisect render` of a small image, with more arguments.
  ProgramRun render(const std::vector<std::string>& more = {},
                    const std::string& output = "a.png") {
    std::vector<std::string> arguments{
        "render", asset_path("sphere-20"), "-o", folder_ / output, "--size", "32x24"};
    if (validates()) arguments.emplace_back("--validation");
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_trisect(arguments);
  }

  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }

  // A complaint is one sentence on standard error, nothing is written, and the exit code tells its
  // kind.
  void expect_complaint(const ProgramRun& run, int code, const std::string& part) {
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_EQ(run.err.find("trisect: "), 0U) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(files(), 0U);
  }

  TemporaryFolder folder_;
};

}  // namespace trisect::test
