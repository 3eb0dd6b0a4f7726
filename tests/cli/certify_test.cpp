// The command certify, as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/certify/certified_picture.h"
#include "app/picture/png_pixels.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

class CertifyProgram : public testing::Test {
 protected:
  test::ProgramRun run(std::vector<std::string> words) {
    words.insert(words.begin(), {"certify", model_, "--size", "80x60", "--json", "-"});
    return test::run_trisect(words);
  }

  const test::TemporaryFolder folder_;
  std::string model_ = test::asset_path("torus");
};

TEST_F(CertifyProgram, ProvesTheAnswersOfEveryBackEnd) {
  for (const char* backend : {"vulkan", "opengl", "cpu", "oracle"}) {
    for (const char* surface : {"flat", "phong", "sphere"}) {
      SCOPED_TRACE(std::string(backend) + " " + surface);
      const std::string file = folder_ / "a.png";
      const test::ProgramRun certified =
          run({"--backend", backend, "--surface", surface, "-o", file});
      ASSERT_EQ(certified.exit_code, 0) << certified.err;
      const auto json = nlohmann::json::parse(certified.out);
      const auto& reasons = json["reasons"];
      std::size_t pixels = 0;
      for (const auto& count : reasons) pixels += count.get<std::size_t>();
      EXPECT_EQ(pixels, 80U * 60U);
      EXPECT_EQ(json["wrong"], 0);
      EXPECT_EQ(json["right_hits"], reasons["one_root"]);
      EXPECT_GT(json["right_hits"], 1000);
      EXPECT_LT(json["open"], 5);
      EXPECT_LT(json["off_surface"]["max"], 1e-6);
      const PngPixels picture = read_png_pixels(file);
      EXPECT_EQ(picture.width, 80U);
      EXPECT_EQ(picture.height, 60U + kReasonKeyHeight);
    }
  }
}

// The thesis's bisection misses surfaces and finds others behind them: the exit code is 1, and the
// pixels are named.
TEST_F(CertifyProgram, EndsWithOneIfAnAnswerIsProvenWrong) {
  const test::ProgramRun certified = run({"--preset", "thesis"});
  EXPECT_EQ(certified.exit_code, 1) << certified.err;
  EXPECT_NE(certified.err.find("pixel "), std::string::npos) << certified.err;
  const auto json = nlohmann::json::parse(certified.out);
  EXPECT_GT(json["missed"], 0);
  EXPECT_EQ(json["wrong"], json["wrong_pixels"].size());
}

}  // namespace
}  // namespace trisect
