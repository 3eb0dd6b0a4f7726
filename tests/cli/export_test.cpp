// trisect export as a user runs it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "app/mesh/model_file.h"
#include "tests/support/program.h"

namespace trisect {
namespace {

using test::asset_path;
using test::run_trisect;

class Export : public test::Program {};

TEST_F(Export, WritesTheSurface) {
  for (const std::string name : {"a.obj", "a.ply", "a.stl", "a.glb"}) {
    const test::ProgramRun run = run_trisect({"export", asset_path("sphere-20"), "--error", "0.01",
                                              "-o", folder_ / name, "--json", folder_ / "a.json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    std::ifstream file(folder_ / "a.json");
    const auto json = nlohmann::json::parse(file);
    EXPECT_LE(json["bound"], 0.01);
    EXPECT_EQ(json["open_edges"], 0);
    EXPECT_EQ(json["beyond_error"], 0);
    EXPECT_EQ(json["bytes"], std::filesystem::file_size(folder_ / name));
    EXPECT_EQ(json["triangles"], read_model(folder_ / name).sizes.size());
    EXPECT_NE(run.out.find("closed; off the surface by at most 0.00"), std::string::npos)
        << run.out;
  }
}

TEST_F(Export, DividesAsOftenAsItIsTold) {
  const test::ProgramRun run = run_trisect({"export", asset_path("cube"), "--subdivide", "4",
                                            "--surface", "sphere", "-o", folder_ / "a.obj"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("192 triangles"), std::string::npos) << run.out;
}

TEST_F(Export, SaysWhenTheErrorIsNotProven) {
  const test::ProgramRun run = run_trisect({"export", asset_path("teapot"), "--error", "0.1",
                                            "--surface", "sphere", "-o", folder_ / "a.ply"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_NE(run.out.find("0.1 is not proven for "), std::string::npos) << run.out;
  EXPECT_EQ(files(), 1U);
}

TEST_F(Export, SaysWhatItCannotDo) {
  const auto complain = [&](const std::vector<std::string>& more, const std::string& name, int code,
                            const std::string& part) {
    SCOPED_TRACE(part);
    std::vector<std::string> arguments{"export", asset_path("sphere-20"), "-o", folder_ / name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_complaint(run_trisect(arguments), code, part);
  };
  complain({"--error", "0.01"}, "a.fbx", 2, "the name must end in .obj, .ply, .stl or .glb.");
  complain({}, "a.obj", 2, "--subdivide");
  complain({"--error", "0.01", "--subdivide", "3"}, "a.obj", 2, "--subdivide");
  complain({"--error", "0"}, "a.obj", 2, "--error");
  complain({"--error", "-1"}, "a.obj", 2, "--error");
  complain({"--error", "nan"}, "a.obj", 2, "--error");
  complain({"--error", "1e-9"}, "a.ply", 2, "or OBJ, which has more digits.");
  complain({"--error", "1e-12"}, "a.obj", 2, "alone move vertices");
  complain({"--subdivide", "0"}, "a.obj", 2, "--subdivide");
  complain({"--subdivide", "1000"}, "a.obj", 3, "more than 16 million triangles");
  complain({"--error", "1e-7"}, "a.obj", 3, "more than 16 million triangles");
}

}  // namespace
}  // namespace trisect
