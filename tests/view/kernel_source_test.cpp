// When sources count as changed, by a clock that the tests set.
#include "app/view/kernel_source.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>

#include "tests/support/temporary_folder.h"

namespace trisect::view {
namespace {

using namespace std::chrono_literals;

TEST(KernelSource, SeesAWrittenFileFourTimesASecond) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.glsl";
  std::ofstream(file) << "void main() {}\n";
  KernelSource source(folder.path().string());
  const Clock::time_point start{1h};
  EXPECT_FALSE(source.has_changed(start));
  std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + 5s);
  EXPECT_FALSE(source.has_changed(start + 200ms));
  EXPECT_TRUE(source.has_changed(start + 300ms));
  EXPECT_FALSE(source.has_changed(start + 600ms));
}

TEST(KernelSource, NumbersTheKernelsInUse) {
  KernelSource source("no folder");
  EXPECT_EQ(source.code(), nullptr);
  EXPECT_EQ(source.number(), 0U);
  const auto code = std::make_shared<const KernelCode>();
  source.use(code);
  EXPECT_EQ(source.code(), code);
  EXPECT_EQ(source.number(), 1U);
}

}  // namespace
}  // namespace trisect::view
