// What a picture's file says of it, and what is made of that again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/cli/model_sha256.h"
#include "app/cli/options.h"
#include "app/mesh/model_file.h"
#include "app/picture/image_file.h"
#include "app/picture/image_reader.h"
#include "tests/support/exr_reader.h"
#include "tests/support/file_content.h"
#include "tests/support/program.h"
#include "tests/support/run_program.h"

namespace trisect {
namespace {

using test::run_trisect;
using Words = std::vector<std::string>;

class SavedPictures : public test::Program {
 protected:
  static std::map<std::string, std::string> said_by(const std::string& file) {
    std::map<std::string, std::string> said;
    for (const auto& [name, value] : read_attributes(file)) said[name] = value;
    return said;
  }

  // Makes a.exr or a.png with these options, makes it again from what it says, as b, with more
  // options, and expects the same bytes.
  void expect_repeated(const Words& options, const std::string& ending, const Words& more = {}) {
    const test::ProgramRun first = render(options, "a" + ending);
    ASSERT_EQ(first.exit_code, 0) << first.err;
    Words again{"render", "--from", folder_ / ("a" + ending), "-o", folder_ / ("b" + ending)};
    again.insert(again.end(), more.begin(), more.end());
    const test::ProgramRun second = run_trisect(again);
    ASSERT_EQ(second.exit_code, 0) << second.err;
    EXPECT_EQ(test::content_of(folder_ / ("a" + ending)),
              test::content_of(folder_ / ("b" + ending)));
    EXPECT_EQ(second.out.find("bits may differ"), std::string::npos) << second.out;
  }
};

TEST_F(SavedPictures, AreMadeAgainByteForByte) {
  const Words lit{"--surface", "sphere",    "--fov",       "33.3",         "--crease",
                  "70",        "--shadows", "--light",     "0.1,0.7,0.3",  "--spp",
                  "4",         "--color",   "0.2,0.4,0.1", "--background", "0.3,0.1,0.7"};
  const Words by_opengl{"--backend", "opengl",       "--gl-path",   "fragment", "--shading",
                        "patch",     "--background", "transparent", "--weld",   "0.01"};
  const Words thesis{
      "--preset", "thesis",      "--rank",   "13",         "--alpha", "0.1234567890123456789",
      "--eye",    "1.1,2.3,3.7", "--target", "0.1,0,-0.3", "--up",    "0.1,1,0"};
  for (const Words& options : {lit, by_opengl, thesis}) {
    expect_repeated(options, ".exr");
    expect_repeated(options, ".png");
  }
  expect_repeated({"--repair", "--evals"}, ".exr");
  expect_repeated({"--backend", "cpu", "--aov", "P,Z"}, ".exr");
}

TEST_F(SavedPictures, SayWhoMadeThemOfWhat) {
  ASSERT_EQ(render({"--size", "48x24"}, "a.png").exit_code, 0);
  std::map<std::string, std::string> said = said_by(folder_ / "a.png");
  EXPECT_EQ(said["program"], "trisect " TRISECT_VERSION);
  EXPECT_EQ(said["size"], "48x24");
  EXPECT_EQ(said["model"], test::asset_path("sphere-20"));
  EXPECT_EQ(said["model_sha256"], model_sha256(test::asset_path("sphere-20"), {}));
  for (const char* name : {"commit", "device", "driver", "eye", "accel"}) {
    EXPECT_NE(said[name], "") << name;
  }
  // What was not given is not there.
  for (const char* name : {"color", "crease", "gl_path", "aov", "evals"}) {
    EXPECT_EQ(said.count(name), 0U) << name;
  }
}

TEST_F(SavedPictures, GiveWayToWhatIsGiven) {
  ASSERT_EQ(render({"--fov", "20", "--shadows"}, "a.exr").exit_code, 0);
  const test::ProgramRun run = run_trisect(
      {"render", test::asset_path("cube"), "--from=" + (folder_ / "a.exr").string(), "--size",
       "20x10", "--shading", "depth", "--shadows=false", "-o", folder_ / "b.exr"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::map<std::string, std::string> first = said_by(folder_ / "a.exr");
  std::map<std::string, std::string> second = said_by(folder_ / "b.exr");
  EXPECT_EQ(second["size"], "20x10");
  EXPECT_EQ(second["model"], test::asset_path("cube"));
  EXPECT_EQ(second["shading"], "depth");
  EXPECT_EQ(second["shadows"], "0");
  EXPECT_EQ(second["fov"], "20");
  EXPECT_EQ(second["eye"], first["eye"]);
}

// What was saved and does not go with what is given is left out.
TEST_F(SavedPictures, GiveWayWhereTheyMust) {
  const auto again = [&](const std::string& file, const Words& options) {
    Words words{"render", "--from", folder_ / file, "-o", folder_ / "b.exr"};
    words.insert(words.end(), options.begin(), options.end());
    const test::ProgramRun run = run_trisect(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return said_by(folder_ / "b.exr");
  };
  ASSERT_EQ(render({"--color", "1,0,0", "--shadows", "--evals"}, "a.exr").exit_code, 0);
  const auto depth = again("a.exr", {"--shading", "depth"});
  EXPECT_EQ(depth.at("shading"), "depth");
  EXPECT_EQ(depth.at("background"), "0,0,0");
  EXPECT_EQ(depth.at("shadows"), "0");
  const auto thesis = again("a.exr", {"--preset", "thesis"});
  EXPECT_EQ(thesis.at("solver"), "bisect");
  EXPECT_EQ(thesis.at("shell"), "height");
  EXPECT_EQ(thesis.at("shading"), "grid");
  EXPECT_EQ(thesis.at("color"), "1,0,0");
  EXPECT_EQ(again("a.exr", {"--backend", "cpu"}).at("accel"), "list");
  ASSERT_EQ(render({"--backend", "opengl", "--gl-path", "fragment"}, "gl.png").exit_code, 0);
  EXPECT_EQ(again("gl.png", {"--backend", "vulkan", "--shadows"}).count("gl_path"), 0U);
  ASSERT_EQ(render({"--tile", "0,0,32,10"}, "part.png").exit_code, 0);
  EXPECT_EQ(again("part.png", {}).at("tile"), "0,0,32,10");
  EXPECT_EQ(again("part.png", {"--size", "16x12"}).count("tile"), 0U);
}

// A file that says nonsense is bad input, named, and does not keep help from being given.
TEST_F(SavedPictures, AreRefusedIfTheySayWhatCannotBe) {
  Frame frame;
  frame.resize(4, 4, false);
  const auto expect_refused = [&](const std::string& name, const std::string& value) {
    ImageContents contents;
    contents.attributes = {
        {"program", std::string("trisect 0")}, {"model", test::asset_path("cube")}, {name, value}};
    save_image(frame, folder_ / "bad.png", contents);
    const test::ProgramRun run =
        run_trisect({"render", "--from", folder_ / "bad.png", "-o", folder_ / "b.png"});
    EXPECT_EQ(run.exit_code, 3) << run.err;
    EXPECT_NE(run.err.find("bad.png: what it says of how it was made cannot be: "),
              std::string::npos)
        << run.err;
  };
  expect_refused("size", "0x0");
  expect_refused("size", "60000x60000");
  expect_refused("backend", "gpu");
  expect_refused("spp", "7");
  expect_refused("fov", "nan");
  expect_refused("color", "1,2");
  expect_refused("aov", "bogus");
  expect_refused("tile", "0,0,900,1");
  EXPECT_EQ(run_trisect({"render", "--from", "none.png", "--help"}).exit_code, 0);
}

TEST_F(SavedPictures, TellOfAnotherModelDeviceOrNothing) {
  const std::string model = folder_ / "model.obj";
  std::filesystem::copy_file(test::asset_path("cube"), model);
  ASSERT_EQ(run_trisect({"render", model, "-o", folder_ / "a.png", "--size", "8x8"}).exit_code, 0);
  std::ofstream(model, std::ios::app) << "# changed\n";
  const Words again{"render", "--from", folder_ / "a.png", "-o", folder_ / "b.png"};
  const test::ProgramRun changed = run_trisect(again);
  EXPECT_EQ(changed.exit_code, 3);
  EXPECT_NE(changed.err.find("is not the model of"), std::string::npos) << changed.err;
  Words named = again;
  named.push_back(model);
  EXPECT_EQ(run_trisect(named).exit_code, 0);

  Words by_cpu = named;
  by_cpu.insert(by_cpu.end(), {"--backend", "cpu"});
  EXPECT_NE(run_trisect(by_cpu).out.find("bits may differ"), std::string::npos);

  std::filesystem::remove(folder_ / "b.png");
  Frame frame;
  frame.resize(4, 4, false);
  save_image(frame, folder_ / "silent.png");
  const test::ProgramRun silent =
      run_trisect({"render", "--from", folder_ / "silent.png", "-o", folder_ / "b.png"});
  EXPECT_EQ(silent.exit_code, 3);
  EXPECT_NE(silent.err.find("does not say how it was made"), std::string::npos) << silent.err;
  EXPECT_EQ(
      run_trisect({"render", "--from", folder_ / "none.exr", "-o", folder_ / "b.png"}).exit_code,
      3);
  std::ofstream(folder_ / "bad.png") << "no picture";
  EXPECT_EQ(
      run_trisect({"render", "--from", folder_ / "bad.png", "-o", folder_ / "b.png"}).exit_code, 3);
  EXPECT_EQ(run_trisect({"render", "--from", folder_ / "a.pfm", "-o", folder_ / "b.png"}).exit_code,
            2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.png"));
}

TEST_F(SavedPictures, HoldTheOutputsThatAreAskedFor) {
  const auto channels = [&](const std::string& aovs) {
    EXPECT_EQ(render({"--aov", aovs}, "a.exr").exit_code, 0);
    std::string names;
    for (const auto& [name, type] : test::exr_channels(folder_ / "a.exr")) names += name + " ";
    return names;
  };
  EXPECT_EQ(channels("color"), "A B G R ");
  EXPECT_EQ(channels("Z,patch"), "Z patch ");
  EXPECT_EQ(channels("P,N,G,uv,evals"), "G.X G.Y G.Z N.X N.Y N.Z P.X P.Y P.Z U V evals ");
  // What is asked for is counted.
  EXPECT_EQ(said_by(folder_ / "a.exr").at("evals"), "1");
  ASSERT_EQ(render({"--aov", "color,Z,N,G,patch,uv,evals"}, "a.exr").exit_code, 0);
  const std::vector<double> evals = test::exr_channel(folder_ / "a.exr", "evals");
  EXPECT_GT(*std::max_element(evals.begin(), evals.end()), 0.0);
  std::filesystem::remove(folder_ / "a.exr");
  expect_complaint(render({"--aov", "depth"}, "a.exr"), 2, "'depth' is not one of: color, Z");
  expect_complaint(render({"--aov", ""}, "a.exr"), 2, "--aov");
  expect_complaint(render({"--aov", "Z,Z"}, "a.exr"), 2, "'Z' is there twice");
  expect_complaint(render({"--aov", "Z"}, "a.png"), 2, "a PNG holds the colour alone");
  expect_complaint(render({"--aov", "Z,N"}, "a.pfm"), 2, "a PFM holds one of");
  expect_complaint(render({"--aov", "uv"}, "a.pfm"), 2, "a PFM holds one of");
}

// The sphere surface of a sphere is the unit sphere, and each hit lies on its pixel's ray.
TEST_F(SavedPictures, HoldPositions) {
  for (const char* spp : {"1", "4", "9"}) {
    ASSERT_EQ(
        render({"--surface", "sphere", "--aov", "P,Z,patch", "--spp", spp}, "a.exr").exit_code, 0);
    const auto channel = [&](const char* name) {
      return test::exr_channel(folder_ / "a.exr", name);
    };
    const std::vector<double> x = channel("P.X");
    const std::vector<double> y = channel("P.Y");
    const std::vector<double> z = channel("P.Z");
    const std::vector<double> distance = channel("Z");
    std::map<std::string, std::string> said = said_by(folder_ / "a.exr");
    const glm::dvec3 eye = parse_triple("eye", said["eye"]);
    std::size_t hits = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const glm::dvec3 p(x[i], y[i], z[i]);
      if (distance[i] == 0.0) {
        EXPECT_EQ(p, glm::dvec3(0.0));
        continue;
      }
      ++hits;
      // Z, some 3, is rounded to single precision, and so are the three.
      EXPECT_NEAR(glm::length(p), 1.0, 1e-6) << spp;
      EXPECT_NEAR(glm::distance(p, eye), distance[i], 1e-6) << spp;
    }
    EXPECT_GT(hits, 100U);
  }
}

TEST_F(SavedPictures, CarryTheModelsChecksum) {
  std::ofstream(folder_ / "abc") << "abc";
  // FIPS 180-4's example of one block.
  EXPECT_EQ(model_sha256(folder_ / "abc", {}),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  std::ofstream(folder_ / "a") << "a";
  std::ofstream(folder_ / "bc") << "bc";
  EXPECT_EQ(model_sha256(folder_ / "a", {folder_ / "bc"}), model_sha256(folder_ / "abc", {}));
  EXPECT_THROW(model_sha256(folder_ / "none", {}), std::runtime_error);
  EXPECT_THROW(model_sha256(folder_.path(), {}), std::runtime_error);
  // The files that a model names count, but none that is not read.
  std::ofstream(folder_ / "m.obj")
      << "mtllib m.mtl none.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder_ / "m.mtl") << "newmtl red\nKd 1 0 0\n";
  const std::vector<std::filesystem::path> files = read_model(folder_ / "m.obj").files;
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].filename(), "m.mtl");
}

// docs/unproject.py as docs/images.md has it: the sphere surface of a sphere is the unit sphere.
TEST_F(SavedPictures, AreUnprojectedByTheExample) {
  const auto write = [&](const std::string& aov) {
    const test::ProgramRun run = render({"--surface", "sphere", "--backend", "oracle", "--aov", aov,
                                         "--stats", folder_ / "figures.json"},
                                        aov + ".pfm");
    ASSERT_EQ(run.exit_code, 0) << run.err;
  };
  write("Z");
  write("N");
  const std::string command = fmt::format(
      "cd {} && /usr/bin/python3 {}/docs/unproject.py Z.pfm N.pfm figures.json points.ply",
      folder_.path().string(), TRISECT_SOURCES);
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(folder_ / "points.ply");
  for (std::string line; line != "end_header";) ASSERT_TRUE(std::getline(file, line));
  const auto json = nlohmann::json::parse(std::ifstream(folder_ / "figures.json"));
  std::size_t points = 0;
  for (std::string line; std::getline(file, line); ++points) {
    std::istringstream numbers(line);
    glm::dvec3 p(0.0);
    glm::dvec3 n(0.0);
    numbers >> p.x >> p.y >> p.z >> n.x >> n.y >> n.z;
    // Z, some 3 away, and N are rounded to single precision.
    EXPECT_NEAR(glm::length(p), 1.0, 5e-7);
    EXPECT_NEAR(glm::length(n), 1.0, 5e-7);
    EXPECT_LT(glm::distance(p, n), 1e-3);
  }
  EXPECT_EQ(points, json["hits"]);
}

}  // namespace
}  // namespace trisect
