// The reports of `trisect bench`, compare and crosscheck as a user gets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/file_content.h"
#include "tests/support/program.h"

namespace trisect {
namespace {

using test::run_trisect;

class Reports : public test::Program {};

TEST_F(Reports, TimesTheContenders) {
  expect_complaint(test::run_trisect({"bench"}), 2, "subcommand");
  expect_complaint(test::run_trisect({"bench", "speed", "none.obj"}), 3, "none.obj");
  const test::ProgramRun run = test::run_trisect(
      {"bench", "speed", test::asset_path("sphere-20"), "--size", "80x60", "--runs", "1",
       "--surface", "phong", "--error", "1e-4", "--json", folder_ / "b.json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::ifstream file(folder_ / "b.json");
  const auto rows = nlohmann::json::parse(file)["rows"];
  // One more where the device has ray queries.
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(),
                          [](const auto& row) { return row["contender"] != "rayquery, robust"; }),
            7);
  for (const auto& row : rows) {
    EXPECT_GT(row["ms"]["median"].get<double>(), 0.0);
    if (row["contender"] == "image only") continue;
    EXPECT_GE(row["checked_pixels"].get<int>(), 10);
    const std::string name = row["contender"];
    if (name.find("robust") != std::string::npos) {
      EXPECT_EQ(row["wrong_pixels"].get<int>(), 0);
    }
    if (name.find("Embree") != std::string::npos) {
      EXPECT_LE(row["flat_error"].get<double>(), 1e-4);
    }
  }
}

TEST_F(Reports, ReportsSpeedAgainstError) {
  expect_complaint(test::run_trisect({"bench", "pareto", "none.obj", "-o", folder_ / "r"}), 3,
                   "none.obj");
  expect_complaint(test::run_trisect({"bench", "pareto", test::asset_path("sphere-20")}), 2, "-o");
  // Not such a table.
  expect_complaint(
      test::run_trisect({"bench", "pareto", test::asset_path("sphere-20"), "--hardcases",
                         test::asset_path("sphere-20"), "-o", folder_ / "r"}),
      3, "sphere-20.obj: is not what trisect hardcases");
  // No program is found there.
  expect_complaint(
      test::run_trisect({"bench", "pareto", test::asset_path("sphere-20"), "-o", folder_ / "r"},
                        {"PATH=/nowhere"}),
      3, "gnuplot");
  const std::string table = folder_ / "table.json";
  std::ofstream(table) << R"({"device": "a device", "driver": "a driver", "rows": [{
    "case": "needle", "surface": "phong", "shell": "normal", "solver": "robust", "rays": 120,
    "undecidable": 1, "wrong": 0, "missed": 0, "depth_error_ulp_p50": 0.1,
    "depth_error_ulp_p99": 0.5, "depth_error_ulp_max": 0.7, "nans": 0, "evaluations_per_ray": 3.25,
    "verdict": "pass", "note": ""}]})";
  const test::ProgramRun run = test::run_trisect(
      {"bench", "pareto", test::asset_path("sphere-80"), test::asset_path("sphere-20"), "--quick",
       "--surface", "phong", "--size", "80x60", "--hardcases", table, "-o", folder_ / "r"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(test::content_of(folder_ / "r" / "report.md").find("| needle |"), std::string::npos);
  // The CSV begins with comments that say what the measurements were made with.
  const std::string csv = test::content_of(folder_ / "r" / "report.csv");
  EXPECT_EQ(csv.substr(0, 10), "# Vulkan: ");
  EXPECT_NE(csv.find(", commit "), std::string::npos);
  EXPECT_NE(test::content_of(folder_ / "r" / "report.md").find("(summary-phong.svg)"),
            std::string::npos);
  for (const char* name : {"report.md", "report.html", "report.csv", "sphere-80-phong.svg",
                           "sphere-80-phong.png", "sphere-80-phong-thesis.png",
                           "sphere-20-phong.svg", "summary-phong.svg", "summary-phong.png"}) {
    EXPECT_GT(std::filesystem::file_size(folder_ / "r" / name), 500U) << name;
  }
  std::ifstream file(folder_ / "r" / "report.json");
  const auto scene = nlohmann::json::parse(file)["scenes"][0];
  double thesis = 0.0;
  bool robust_on_front = false;
  for (const auto& one : scene["measurements"]) {
    const std::string family = one["family"];
    if (family == "thesis, height shell" && one["number"] == "Rank 10") thesis = one["rms"];
    if (family.rfind("robust", 0) != 0) continue;
    EXPECT_LT(one["rms"].get<double>(), 1e-6);
    EXPECT_EQ(one["wrong_hits"].get<int>() + one["missed"].get<int>(), 0);
    EXPECT_GT(one["bytes_read"].get<uint64_t>(), 0U);
    robust_on_front = robust_on_front || one["on_front"].get<bool>();
  }
  // Nothing else is as exact, so the fastest of its ways, whichever that was, is dominated by none.
  EXPECT_TRUE(robust_on_front);
  // It drops pixels.
  EXPECT_GT(thesis, 0.1);
}

// On a machine that has neither.
TEST_F(Reports, SpeedAgainstErrorNeedsNoGnuplotAndNoOpenGl) {
  const test::ProgramRun run = test::run_trisect(
      {"bench", "pareto", test::asset_path("sphere-20"), "--quick", "--surface", "phong", "--size",
       "40x30", "--no-plots", "--no-opengl", "-o", folder_ / "r"},
      {"PATH=/nowhere", "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "r" / "sphere-20-phong.svg"));
  const std::string text = test::content_of(folder_ / "r" / "report.md");
  EXPECT_EQ(text.find(".svg"), std::string::npos);
  EXPECT_EQ(text.find("OpenGL tessellation"), std::string::npos);
  EXPECT_NE(text.find("| robust, tiles |"), std::string::npos);
}

TEST_F(Reports, ReportsShadowTerminators) {
  const std::string model = test::asset_path("sphere-80");
  expect_complaint(test::run_trisect({"bench", "terminator", model, model, "-o", folder_ / "t"}), 2,
                   "two models are named sphere-80");
  // A name that ends strings, links and cells, and that a shell would run.
  const std::string name = "it's, a `touch made` (1)|";
  const std::string path = folder_ / (name + ".obj");
  std::filesystem::copy_file(model, path);
  const test::ProgramRun run =
      test::run_trisect({"bench", "terminator", path, "--lights", "100,60,100", "--size", "64x48",
                         "--runs", "1", "-o", folder_ / "t"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_FALSE(std::filesystem::exists("made"));
  for (const std::string& file :
       {std::string("terminator.md"), std::string("terminator.html"), std::string("terminator.csv"),
        name + "-lights.png", name + "-errors.svg", name + "-errors.png"}) {
    EXPECT_GT(std::filesystem::file_size(folder_ / "t" / file), 500U) << file;
  }
  const std::string report = test::content_of(folder_ / "t" / "terminator.md");
  EXPECT_NE(report.find("](it%27s%2C%20a%20%60touch%20made%60%20%281%29%7C-lights.png)"),
            std::string::npos);
  EXPECT_NE(report.find("| it's, a `touch made` (1)\\| | 60 | curved |"), std::string::npos);
  EXPECT_NE(test::content_of(folder_ / "t" / "terminator.csv")
                .find("\n\"it's, a `touch made` (1)|\",80,60,\"curved\","),
            std::string::npos);
  std::ifstream file(folder_ / "t" / "terminator.json");
  const auto rows = nlohmann::json::parse(file)["rows"];
  ASSERT_EQ(rows.size(), 16U);
  for (const auto& row : rows) {
    const std::size_t wrong =
        row["wrongly_dark"].get<std::size_t>() + row["wrongly_bright"].get<std::size_t>();
    EXPECT_GT(row["pixels"], row["lit"]);
    if (row["shadows"] == "curved") {
      EXPECT_EQ(wrong, 0U) << row;
      // Roundings of single precision.
      EXPECT_LT(row["brightness_rmse"], 1e-6) << row;
    } else {
      EXPECT_GT(wrong, 0U) << row;
    }
  }
  // Beginning on the tangent planes leaves less in the dark.
  EXPECT_EQ(rows[1]["shadows"], "flat");
  EXPECT_EQ(rows[4]["shadows"], "Hanika 2021");
  EXPECT_LT(rows[4]["wrongly_dark"], rows[1]["wrongly_dark"]);
}

TEST_F(Reports, ReportsHowNearModelsComeToAShape) {
  const std::string coarse = test::asset_path("sphere-20");
  const std::string fine = test::asset_path("sphere-320");
  expect_complaint(test::run_trisect({"bench", "shape", coarse, "-o", folder_ / "s"}), 2,
                   "--reference");
  expect_complaint(
      test::run_trisect({"bench", "shape", coarse, "--reference", "none.obj", "-o", folder_ / "s"}),
      3, "none.obj");
  const std::string apart = folder_ / "apart.obj";
  std::ofstream(apart) << "v 9 0 0\nv 10 0 0\nv 9 1 0\nf 1 2 3\n";
  const test::ProgramRun refused =
      test::run_trisect({"bench", "shape", apart, "--reference", fine, "-o", folder_ / "a"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("apart.obj: is not where "), std::string::npos) << refused.err;
  const test::ProgramRun run =
      test::run_trisect({"bench", "shape", coarse, "--reference", fine, "--decimate", "100",
                         "--error", "1e-2", "--size", "80x60", "--runs", "1", "-o", folder_ / "s"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name : {"shape.md", "shape.html", "shape.csv", "shape.svg", "shape.png"}) {
    EXPECT_GT(std::filesystem::file_size(folder_ / "s" / name), 500U) << name;
  }
  std::ifstream file(folder_ / "s" / "shape.json");
  const auto shape = nlohmann::json::parse(file)["shape"];
  EXPECT_EQ(shape["triangles"], 320);
  ASSERT_EQ(shape["models"].size(), 10U);
  const auto& flat = shape["models"][0];
  const auto& sphere = shape["models"][4];
  EXPECT_EQ(sphere["surface"], "sphere");
  EXPECT_EQ(shape["models"][5]["model"], "sphere-320-100");
  EXPECT_EQ(shape["models"][5]["triangles"], 100);
  // The reference's own triangles are 0.006 of the radius off the sphere.
  EXPECT_LT(sphere["distance"]["rms"].get<double>(), 0.006);
  EXPECT_GT(flat["distance"]["rms"].get<double>(), 0.05);
  EXPECT_LT(sphere["wrong_pixels"].get<int>(), flat["wrong_pixels"].get<int>());
  for (const auto& row : shape["models"]) {
    for (const char* way : {"to_shape", "to_model"}) {
      const double found = row[way]["found"];
      EXPECT_GE(found, 0.0);
      // A hundredth beyond what was found, and the error of the division.
      EXPECT_LE(row[way]["bound"].get<double>(), 1.011 * found + 0.0101) << row;
      EXPECT_GE(row[way]["bound"].get<double>(), found);
    }
  }
}

TEST_F(Reports, ReportsWhatEachStepIsWorth) {
  expect_complaint(test::run_trisect({"bench", "ablation", "none.obj", "-o", folder_ / "a"}), 3,
                   "none.obj");
  expect_complaint(test::run_trisect({"bench", "ablation", test::asset_path("sphere-20")}), 2,
                   "-o");
  const test::ProgramRun run =
      test::run_trisect({"bench", "ablation", test::asset_path("sphere-20"), "--surface", "phong",
                         "--size", "80x60", "--runs", "1", "-o", folder_ / "a"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name :
       {"ablation.md", "ablation.html", "sphere-20-phong.svg", "sphere-20-phong.png"}) {
    EXPECT_GT(std::filesystem::file_size(folder_ / "a" / name), 500U) << name;
  }
  std::ifstream file(folder_ / "a" / "ablation.json");
  const auto steps = nlohmann::json::parse(file)["ablations"][0]["steps"];
  ASSERT_EQ(steps.size(), 8U);
  const auto wrong = [](const nlohmann::json& step) {
    return step["wrong_hits"].get<int>() + step["missed"].get<int>();
  };
  // The bisection loses pixels, and fewer at the higher Rank; from the robust solver on nothing is
  // lost.
  EXPECT_GT(wrong(steps[0]), 10 * wrong(steps[1]));
  for (std::size_t i = 3; i < steps.size(); ++i) EXPECT_EQ(wrong(steps[i]), 0) << i;
  // Bounds of the control points are tighter than balls and leave fewer candidates.
  EXPECT_LT(steps[5]["candidates"].get<int>(), steps[4]["candidates"].get<int>());
}

TEST_F(Reports, ReportsStability) {
  expect_complaint(test::run_trisect({"bench", "stability"}), 2, "-o");
  const test::ProgramRun run =
      test::run_trisect({"bench", "stability", "--rays", "2", "-o", folder_ / "s"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name :
       {"stability.md", "stability.html", "stability.csv", "stability.svg", "stability.png"}) {
    EXPECT_GT(std::filesystem::file_size(folder_ / "s" / name), 500U) << name;
  }
  std::ifstream file(folder_ / "s" / "stability.json");
  EXPECT_EQ(nlohmann::json::parse(file)["curves"].size(), 15U);
}

TEST_F(Reports, ComparesImages) {
  ASSERT_EQ(render({}, "a.exr").exit_code, 0);
  ASSERT_EQ(render({"--surface", "flat"}, "b.exr").exit_code, 0);
  ASSERT_EQ(render({"--surface", "flat"}, "b.png").exit_code, 0);
  ASSERT_EQ(render({"--size", "8x8"}, "small.png").exit_code, 0);
  const auto compare = [&](const std::string& a, const std::string& b,
                           const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"compare", folder_ / a, folder_ / b};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_trisect(arguments);
  };
  EXPECT_EQ(compare("a.exr", "a.exr").exit_code, 0);
  // Depths and colours differ, and so do outlines.
  const test::ProgramRun differs =
      compare("a.exr", "b.exr", {"--json", folder_ / "c.json", "--diff", folder_ / "d.png"});
  EXPECT_EQ(differs.exit_code, 1);
  EXPECT_NE(differs.out.find("too far apart: hit mismatches"), std::string::npos) << differs.out;
  std::ifstream file(folder_ / "c.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_GT(json["hit_mismatches"], 0);
  EXPECT_GT(json["z_ulp"]["max"], 1000.0);
  EXPECT_FALSE(json["excesses"].empty());
  EXPECT_GT(std::filesystem::file_size(folder_ / "d.png"), 100U);
  // What is asked for decides. A PNG is rounded to 8 bits.
  EXPECT_EQ(compare("a.exr", "b.exr",
                    {"--threshold", "hit_mismatches=1", "--threshold", "patch_mismatches=1",
                     "--threshold", "color_max=255"})
                .exit_code,
            0);
  EXPECT_EQ(compare("b.exr", "b.exr", {"--threshold", "color_max=0"}).exit_code, 0);
  EXPECT_EQ(compare("a.exr", "a.exr", {"--threshold", "color=0"}).exit_code, 2);
  EXPECT_EQ(compare("a.exr", "a.exr", {"--threshold", "color_max=-1"}).exit_code, 2);
  EXPECT_EQ(compare("b.png", "small.png").exit_code, 3);
  EXPECT_EQ(compare("b.png", "absent.png").exit_code, 3);
  std::ofstream(folder_ / "broken.exr") << "not an image";
  EXPECT_EQ(compare("broken.exr", "b.exr").exit_code, 3);
}

TEST_F(Reports, CrosschecksBackEnds) {
  const auto crosscheck = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"crosscheck", test::asset_path("sphere-20"), "--size",
                                       "48x36"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_trisect(arguments);
  };
  const test::ProgramRun run = crosscheck({"--backends", "vulkan,opengl,cpu,oracle", "--json",
                                           folder_ / "c.json", "--diff", folder_ / "d.exr"});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  std::ifstream file(folder_ / "c.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json["backends"].size(), 4U);
  EXPECT_EQ(json["pairs"].size(), 6U);
  EXPECT_EQ(json["pairs"][0]["z_bit_equal"], json["pairs"][0]["z_pixels"]);
  // The bisection loses pixels that the oracle has.
  EXPECT_EQ(crosscheck({"--preset", "thesis", "--backends", "vulkan,oracle"}).exit_code, 1);
  EXPECT_EQ(crosscheck({"--backends", "vulkan"}).exit_code, 2);
  EXPECT_EQ(crosscheck({"--backends", "vulkan,vulkan"}).exit_code, 2);
  EXPECT_EQ(crosscheck({"--backends", "vulkan,metal"}).exit_code, 2);
}

}  // namespace
}  // namespace trisect
