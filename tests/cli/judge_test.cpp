// The commands rays, cast and judge, as a user runs them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/judge/ray_file.h"
#include "tests/support/file_content.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

class JudgeProgram : public testing::Test {
 protected:
  test::ProgramRun run(std::vector<std::string> words) {
    words.insert(words.end(), {"--surface", surface_});
    return test::run_trisect(words);
  }

  const test::TemporaryFolder folder_;
  std::string rays_ = folder_ / "a.rays";
  std::string hits_ = folder_ / "a.hits";
  std::string model_ = test::asset_path("torus");
  std::string surface_ = "phong";
};

TEST_F(JudgeProgram, FindsTheProgramsOwnHitsRightOnEveryBackEnd) {
  for (const char* surface : {"flat", "phong", "sphere"}) {
    surface_ = surface;
    ASSERT_EQ(run({"rays", model_, "-o", rays_, "--count", "40"}).exit_code, 0);
    for (const char* backend : {"vulkan", "cpu", "oracle"}) {
      const test::ProgramRun cast = run({"cast", rays_, model_, "-o", hits_, "--backend", backend});
      ASSERT_EQ(cast.exit_code, 0) << cast.err;
      EXPECT_NE(cast.out.find(" of 320 rays hit"), std::string::npos) << cast.out;
      const test::ProgramRun judged = run({"judge", rays_, hits_, model_, "--json", "-"});
      EXPECT_EQ(judged.exit_code, 0) << surface << backend << judged.err;
      const auto json = nlohmann::json::parse(judged.out);
      EXPECT_EQ(json["rays"], 320);
      EXPECT_EQ(json["wrong"], 0);
      EXPECT_GT(json["hits"], 150);
      EXPECT_LT(json["undecidable"], 100);
    }
  }
}

TEST_F(JudgeProgram, ListsWhatIsWrongAndEndsWithOne) {
  ASSERT_EQ(run({"rays", model_, "-o", rays_, "--count", "20", "--kind", "random"}).exit_code, 0);
  ASSERT_EQ(run({"cast", rays_, model_, "-o", hits_, "--backend", "oracle"}).exit_code, 0);
  std::vector<FileHit> hits = read_hits(hits_);
  ASSERT_NE(hits[3].triangle, NO_TRIANGLE);
  hits[3] = {};
  const std::string changed = folder_ / "changed.csv";
  std::ofstream(changed) << hits_for(changed, hits);
  const std::string wrong = folder_ / "wrong.csv";
  const test::ProgramRun judged = run({"judge", rays_, changed, model_, "--wrong", wrong});
  EXPECT_EQ(judged.exit_code, 1) << judged.err;
  EXPECT_NE(judged.out.find("missed               1\n"), std::string::npos) << judged.out;
  const std::string listed = test::content_of(wrong);
  EXPECT_TRUE(
      listed.starts_with("ray,verdict,t,triangle,true_t,true_u,true_v,true_triangle,place\n"
                         "3,missed,,-1,"))
      << listed;
  EXPECT_EQ(std::count(listed.begin(), listed.end(), '\n'), 2);
}

// The same numbers, whatever the format.
TEST_F(JudgeProgram, TakesTextForBinary) {
  const std::string text = folder_ / "a.csv";
  const std::string text_hits = folder_ / "hits.csv";
  for (const std::string& rays : {rays_, text}) {
    ASSERT_EQ(run({"rays", model_, "-o", rays, "--count", "5"}).exit_code, 0);
  }
  ASSERT_EQ(run({"cast", rays_, model_, "-o", hits_, "--backend", "cpu"}).exit_code, 0);
  ASSERT_EQ(run({"cast", text, model_, "-o", text_hits, "--backend", "cpu"}).exit_code, 0);
  EXPECT_EQ(hits_for("a", read_hits(text_hits)), test::content_of(hits_));
}

// The example of docs/judge.md. Nearly all that they find is right, as Embree's triangles and the
// rasteriser's pixels are; what is not is what the judge is for.
TEST_F(JudgeProgram, JudgesTracersOfOthers) {
  surface_ = "flat";
  const std::string others =
      std::filesystem::path(test::program_path()).parent_path() / "other-tracers";
  const auto json = [&] {
    const test::ProgramRun judged = run({"judge", rays_, hits_, model_, "--json", "-"});
    EXPECT_EQ(judged.exit_code <= 1, true) << judged.err;
    return nlohmann::json::parse(judged.out);
  };
  ASSERT_EQ(run({"rays", model_, "-o", rays_, "--kind", "random", "--count", "400"}).exit_code, 0);
  for (const char* tracer : {"embree", "embree-robust"}) {
    ASSERT_EQ(test::run_program({others, tracer, rays_, model_, hits_}).exit_code, 0);
    const auto judged = json();
    EXPECT_GT(judged["hits"], 390) << tracer;
    EXPECT_LT(judged["weights"]["p50"], 1e-5) << tracer;
  }
  ASSERT_EQ(test::run_program({others, "opengl", model_, rays_, hits_}).exit_code, 0);
  const auto judged = json();
  EXPECT_EQ(judged["rays"], 120000);
  EXPECT_GT(judged["hits"], 20000);
  EXPECT_LT(judged["wrong"], 120);
  EXPECT_LT(judged["ulp"]["p50"], 4.0);
}

}  // namespace
}  // namespace trisect
