// Temporary files go with what made them, or with the process.
#include "app/base/temporary_names.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <iterator>
#include <optional>
#include <system_error>
#include <thread>

#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

std::size_t files_in(const test::TemporaryFolder& folder) {
  const std::filesystem::directory_iterator files(folder.path());
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TEST(TemporaryNames, AreRemovedUnlessTheyAreReleased) {
  const test::TemporaryFolder folder;
  std::filesystem::path kept;
  {
    const TemporaryName gone(folder.path(), 0600);
    TemporaryName stays(folder.path(), 0600);
    EXPECT_NE(gone.path(), stays.path());
    EXPECT_EQ(files_in(folder), 2U);
    kept = stays.path();
    stays.release();
  }
  EXPECT_EQ(files_in(folder), 1U);
  EXPECT_TRUE(std::filesystem::exists(kept));
  EXPECT_THROW(TemporaryName(folder / "none", 0600), std::system_error);
}

// As a signal handler ends the program.
TEST(TemporaryNames, GoWithTheProcess) {
  const test::TemporaryFolder folder;
  std::filesystem::path kept;
  {
    TemporaryName stays(folder.path(), 0600);
    kept = stays.path();
    stays.release();
  }
  const auto end = [&] {
    std::array<std::optional<TemporaryName>, 64> names;
    for (auto& name : names) name.emplace(folder.path(), 0600);
    // What went before has left its place to others.
    for (std::size_t i = 0; i < 64; i += 2) names[i].emplace(folder.path(), 0600);
    if (files_in(folder) != 65) _exit(1);
    remove_temporary_files();
    _exit(files_in(folder) == 1 ? 0 : 2);
  };
  EXPECT_EXIT(end(), testing::ExitedWithCode(0), "");
  EXPECT_TRUE(std::filesystem::exists(kept));
}

// A handler may run while other threads make and remove files.
TEST(TemporaryNames, GoWithTheProcessWhateverItsThreadsDo) {
  const test::TemporaryFolder folder;
  const auto end = [&] {
    std::array<std::thread, 3> threads;
    for (std::thread& thread : threads) {
      thread = std::thread([&] {
        for (;;) TemporaryName(folder.path(), 0600);
      });
    }
    usleep(20000);
    remove_temporary_files();
    _exit(0);
  };
  EXPECT_EXIT(end(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace trisect
