#include "app/cli/data_folder.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

TEST(DataFolder, IsTheInstalledOneWhereThereIsOne) {
  const test::TemporaryFolder prefix;
  const fs::path program = prefix / "bin" / "trisect";
  EXPECT_EQ(data_folder(program, "assets", "/source/assets"), "/source/assets");
  fs::create_directories(prefix / "share" / "trisect" / "assets");
  EXPECT_EQ(data_folder(program, "assets", "/source/assets"),
            prefix / "share" / "trisect" / "assets");
  EXPECT_EQ(data_folder(program, "shaders", "/source/shaders"), "/source/shaders");
}

TEST(DataFolder, OfAProgramInTheBuildTreeIsTheSourceTrees) {
  EXPECT_EQ(data_folder("assets", "/source/assets"), "/source/assets");
}

}  // namespace
}  // namespace trisect
