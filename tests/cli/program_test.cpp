// The program as a user runs it: exit codes, messages, files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/base/srgb.h"
#include "app/picture/image_file.h"
#include "app/picture/image_reader.h"
#include "tests/support/exr_reader.h"
#include "tests/support/file_content.h"
#include "tests/support/program.h"
#include "tests/support/run_program.h"

namespace trisect {
namespace {

using test::Program;
using test::run_trisect;
using Words = std::vector<std::string>;

TEST_F(Program, RendersAPicture) {
  const test::ProgramRun run = render();
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("20 triangles, 12 vertices"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("a.png"), std::string::npos) << run.out;
  EXPECT_GT(std::filesystem::file_size(folder_ / "a.png"), 100U);
  EXPECT_EQ(files(), 1U);
}

TEST_F(Program, WritesStatistics) {
  const test::ProgramRun run =
      render({"--surface", "sphere", "--rank", "12", "--runs", "3", "--stats", folder_ / "s.json"},
             "a.exr");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::ifstream file(folder_ / "s.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json["surface"], "sphere");
  EXPECT_EQ(json["rank"], 12);
  EXPECT_EQ(json["runs"], 3);
  EXPECT_EQ(json["patches"], 20);
  EXPECT_EQ(json["width"], 32);
  EXPECT_EQ(json["height"], 24);
  EXPECT_LE(json["gpu_ms"]["min"], json["gpu_ms"]["median"]);
  EXPECT_LE(json["gpu_ms"]["median"], json["gpu_ms"]["max"]);
  EXPECT_GT(json["gpu_ms"]["min"], 0.0);
  const Frame frame = test::read_exr(folder_ / "a.exr");
  EXPECT_EQ(json["hits"], frame.hits());
  EXPECT_GT(frame.hits(), 100U);
}

TEST_F(Program, PlacesTheCamera) {
  // Straight down the z axis at a distance of 3: the sphere's near pole is 2 away.
  const test::ProgramRun run =
      render({"--surface", "sphere", "--rank", "20", "--size", "33x33", "--eye", "0,0,3",
              "--target", "0,0,0", "--up", "0,1,0", "--fov", "60"},
             "a.exr");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Frame frame = test::read_exr(folder_ / "a.exr");
  EXPECT_NEAR(frame.aovs[16 * 33 + 16].normal_z.w, 2.0F,
              2e-4F);  // the bisection's tolerance is 1e-4
}

TEST_F(Program, ComplainsAboutUsageWithCode2) {
  expect_complaint(run_trisect({}), 2, "A subcommand is required");
  expect_complaint(run_trisect({"frobnicate"}), 2, "'frobnicate' is not a command");
  expect_complaint(run_trisect({"render", "-o", folder_ / "a.png"}), 2, "MODEL");
  expect_complaint(run_trisect({"render", test::asset_path("cube")}), 2, "--output");
  expect_complaint(render({"--surface", "bumpy"}), 2, "--surface");
  expect_complaint(render({"--solver", "guess"}), 2, "--solver");
  expect_complaint(render({"--rank", "0"}), 2, "--rank");
  expect_complaint(render({"--rank", "61"}), 2, "--rank");
  expect_complaint(render({"--fov", "180"}), 2, "--fov");
  expect_complaint(render({"--alpha", "much"}), 2, "--alpha");
  expect_complaint(render({"--alpha", "nan"}), 2, "--alpha");
  expect_complaint(render({"--runs", "0"}), 2, "--runs");
  expect_complaint(render({"--rank", "1.5"}), 2, "--rank: '1.5' is not a whole number");
  expect_complaint(render({"--size", "32"}), 2, "--size");
  expect_complaint(render({"--size", ""}), 2, "--size");
  expect_complaint(render({"--stats", ""}), 2, "--stats");
  expect_complaint(render({"--device", ""}), 2, "--device");
  expect_complaint(render({"--stats", folder_ / "a.png"}), 2, "the same file");
  expect_complaint(render({"--eye", "1e30,0,0"}), 2, "--eye");
  expect_complaint(render({"--eye", "1,2"}), 2, "--eye");
  expect_complaint(render({"--eye", "0,0,0", "--target", "0,0,0"}), 2, "--eye");
  expect_complaint(render({"--nonsense"}), 2, "--nonsense");
  expect_complaint(render({}, "a.bmp"), 2, "a.bmp");
}

TEST_F(Program, ComplainsAboutFilesWithCode3) {
  expect_complaint(run_trisect({"render", "absent.obj", "-o", folder_ / "a.png"}), 3, "absent.obj");
  const test::TemporaryFolder models;
  std::ofstream(models / "file") << "no folder";
  const std::vector<std::string> cube{"render", test::asset_path("cube"), "--size", "32x24"};
  const auto with = [&](const std::vector<std::string>& outputs) {
    std::vector<std::string> arguments = cube;
    arguments.insert(arguments.end(), outputs.begin(), outputs.end());
    return run_trisect(arguments);
  };
  expect_complaint(with({"-o", models / "file/a.png"}), 3, "file: the folder cannot be made");
  expect_complaint(with({"-o", folder_ / "a.png", "--stats", models / "file/s.json"}), 3,
                   "file: the folder cannot be made");
  std::ofstream(models / "bad.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n";
  expect_complaint(run_trisect({"render", models / "bad.obj", "-o", folder_ / "a.png"}), 3,
                   "bad.obj, line 4");
}

TEST_F(Program, PicksAnAccelerationAndSaysWhich) {
  expect_complaint(render({"--accel", "tiles", "--preset", "thesis"}), 2, "--solver robust");
  expect_complaint(render({"--accel", "tiles", "--backend", "opengl"}), 2, "--backend vulkan");
  expect_complaint(render({"--accel", "bvh", "--backend", "cpu"}), 2, "--backend vulkan");
  const auto accel = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"--stats", folder_ / "s.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(render(arguments).exit_code, 0);
    std::ifstream file(folder_ / "s.json");
    return nlohmann::json::parse(file)["accel"].get<std::string>();
  };
  // The model has more than four subpatches for each tile of the small image, and fewer for the
  // large one.
  EXPECT_EQ(accel({}), "bvh");
  EXPECT_EQ(accel({"--size", "240x160"}), "tiles");
  EXPECT_EQ(accel({"--accel", "auto", "--size", "240x160"}), "tiles");
  EXPECT_EQ(accel({"--accel", "tiles"}), "tiles");
  EXPECT_EQ(accel({"--accel", "list"}), "list");
  EXPECT_EQ(accel({"--accel", "bvh"}), "bvh");
  EXPECT_EQ(accel({"--preset", "thesis"}), "list");
  EXPECT_EQ(accel({"--backend", "cpu"}), "list");
}

TEST_F(Program, ComparesEveryChannelIfItIsAsked) {
  const auto on_cpu = [&](Words more, const std::string& name) {
    more.insert(more.end(), {"--backend", "cpu"});
    return render(more, name);
  };
  const auto compared = [&](const char* a, const char* b, Words more = {}) {
    more.insert(more.begin(), {"compare", folder_ / a, folder_ / b});
    return run_trisect(more);
  };
  ASSERT_EQ(on_cpu({}, "a.exr").exit_code, 0);
  ASSERT_EQ(on_cpu({"--aov", "color,Z,N,G,patch"}, "less.exr").exit_code, 0);
  Frame frame = read_image(folder_ / "a.exr");
  const auto middle = static_cast<std::ptrdiff_t>(frame.aovs.size() / 2);
  frame.aovs[static_cast<std::size_t>(middle)].geometric_u.w += 0.25F;
  {
    AtomicFile file(folder_ / "u.exr");
    write_exr(frame, file);
    file.commit();
  }
  EXPECT_EQ(compared("a.exr", "a.exr", {"--exact"}).exit_code, 0);
  // Nothing else looks at the barycentric weights.
  EXPECT_EQ(compared("a.exr", "u.exr").exit_code, 0);
  const test::ProgramRun exact =
      compared("a.exr", "u.exr", {"--exact", "--json", folder_ / "c.json"});
  EXPECT_EQ(exact.exit_code, 1);
  EXPECT_NE(exact.out.find("channel U has other bits in 1 pixels"), std::string::npos) << exact.out;
  std::ifstream file(folder_ / "c.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json["channels"]["U"], 1);
  EXPECT_EQ(json["channels"]["V"], 0);
  const test::ProgramRun less = compared("a.exr", "less.exr", {"--exact"});
  EXPECT_EQ(less.exit_code, 1);
  EXPECT_NE(less.out.find("a.exr has the channel U"), std::string::npos) << less.out;
  // The same pixels elsewhere in an image.
  ASSERT_EQ(on_cpu({"--tile", "0,0,2,2"}, "corner.exr").exit_code, 0);
  ASSERT_EQ(on_cpu({"--tile", "1,0,2,2"}, "beside.exr").exit_code, 0);
  const test::ProgramRun moved =
      compared("corner.exr", "beside.exr", {"--threshold", "color_max=255"});
  EXPECT_EQ(moved.exit_code, 1);
  EXPECT_NE(moved.out.find("the second at 1,0 in an image of 32x24"), std::string::npos);
  ASSERT_EQ(on_cpu({}, "a.png").exit_code, 0);
  EXPECT_EQ(compared("a.exr", "a.png", {"--exact"}).exit_code, 2);
}

// The acceleration is Vulkan's, whatever it is compared with.
TEST_F(Program, ComparesEveryAccelerationWithOtherBackEnds) {
  const auto crosscheck = [](const Words& options) {
    Words words{"crosscheck", test::asset_path("cube"), "--size", "32x24"};
    words.insert(words.end(), options.begin(), options.end());
    return run_trisect(words);
  };
  for (const char* accel : {"list", "tiles", "bvh"}) {
    const test::ProgramRun run =
        crosscheck({"--accel", accel, "--backends", "vulkan,opengl,cpu", "--json", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto backends = nlohmann::json::parse(run.out)["backends"];
    EXPECT_EQ(backends[0]["accel"], accel);
    EXPECT_EQ(backends[1]["accel"], "list");
  }
  expect_complaint(crosscheck({"--accel", "bvh", "--backends", "opengl,cpu"}), 2,
                   "none of the back ends is vulkan");
}

TEST_F(Program, LightsFromADirection) {
  expect_complaint(render({"--light", "0,0,0"}), 2, "no direction");
  expect_complaint(render({"--shading", "shiny"}), 2, "--shading: 'shiny' is not one of: plain");
  for (const char* color : {"", "1", "0,0,1.01", "0,-0.1,0", "nan,0,0", "0,0,0,0", "blue"}) {
    expect_complaint(render({"--color", color}), 2, "' is not a colour, three numbers");
    expect_complaint(render({"--background", color}), 2, "' is not sky, transparent or a colour");
  }
  expect_complaint(render({"--shadows", "--shading", "depth"}), 2, "no light falls");
  expect_complaint(render({"--color", "1,0,0", "--shading", "patch"}), 2, "has others");
  ASSERT_EQ(render({"--light", "0,0,1"}, "front.exr").exit_code, 0);
  ASSERT_EQ(render({"--light", "0,0,-5"}, "back.exr").exit_code, 0);
  const Frame front = test::read_exr(folder_ / "front.exr");
  const Frame back = test::read_exr(folder_ / "back.exr");
  // The middle of the sphere that the camera faces.
  const std::size_t middle = 12U * 32U + 16U;
  EXPECT_GT(front.colors.at(middle).x, 2.0F * back.colors.at(middle).x);
}

TEST_F(Program, CastsShadows) {
  expect_complaint(render({"--shadows", "--solver", "bisect"}), 2, "--solver robust");
  expect_complaint(render({"--shadows", "--gl-path", "fragment"}), 2, "--gl-path compute");
  // From behind: what the camera faces is all in shadow.
  for (const char* backend : {"vulkan", "opengl", "cpu", "oracle"}) {
    ASSERT_EQ(render({"--light", "0,-1,-1", "--shadows", "--shading", "grid", "--backend", backend},
                     "a.exr")
                  .exit_code,
              0);
    const Frame image = test::read_exr(folder_ / "a.exr");
    const vec4 middle = image.colors.at(12U * 32U + 16U);
    EXPECT_NEAR(middle.x, linear_from_srgb(0.25F), 1e-6F) << backend;
    EXPECT_EQ(middle.w, 1.0F) << backend;
  }
}

TEST_F(Program, AveragesSeveralRaysAPixel) {
  expect_complaint(render({"--spp", "5"}), 2, "--spp");
  expect_complaint(render({"--spp", "16", "--size", "8000x10"}), 2, "16384 rays a side");
  ASSERT_EQ(render({"--spp", "16", "--evals"}, "a.exr").exit_code, 0);
  const Frame image = test::read_exr(folder_ / "a.exr");
  EXPECT_EQ(image.width, 32U);
  EXPECT_EQ(image.height, 24U);
  // At the outline some of a pixel's rays hit.
  EXPECT_TRUE(std::any_of(image.colors.begin(), image.colors.end(),
                          [](const vec4& color) { return color.w > 0.0F && color.w < 1.0F; }));
}

TEST_F(Program, SaysWhatAModelIsLike) {
  expect_complaint(run_trisect({"info", folder_ / "none.glb"}), 3, "none.glb: cannot be opened");
  expect_complaint(run_trisect({"info"}), 2, "MODEL");
  const std::string file = folder_ / "info.json";
  std::ofstream(folder_ / "two.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\no one\nf 1 2 3\no "
                                        "two\nf 2 3 4\nl 1 4\n";
  const test::ProgramRun run = run_trisect({"info", folder_ / "two.obj", "--json", file});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("1 line element left out"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("--repair turns triangles around"), std::string::npos) << run.out;
  std::ifstream stream(file);
  const auto json = nlohmann::json::parse(stream);
  EXPECT_EQ(json["format"], "OBJ");
  EXPECT_EQ(json["meshes"][1]["name"], "two");
  EXPECT_EQ(json["edges"]["opposite_winding"], 1);
  EXPECT_EQ(json["surface"]["surface"], "phong");
  EXPECT_EQ(json["advice"].size(), 3U) << json["advice"];
  const test::ProgramRun repaired =
      run_trisect({"info", folder_ / "two.obj", "--repair", "--surface", "sphere"});
  EXPECT_NE(repaired.out.find("1 triangles turned around"), std::string::npos) << repaired.out;
  EXPECT_NE(repaired.out.find("sphere "), std::string::npos) << repaired.out;
}

TEST_F(Program, SaysHowFarNumbersOfAFileAreRounded) {
  // A triangle in normalised bytes, four of them a vertex.
  nlohmann::json gltf{
      {"asset", {{"version", "2.0"}}},
      {"extensionsUsed", {"KHR_mesh_quantization"}},
      {"buffers",
       {{{"byteLength", 24},
         {"uri", "data:application/octet-stream;base64,AAAAAP8AAAAA/wAAAAB/AAAAfwAAAH8A"}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", 12}, {"byteStride", 4}},
        {{"buffer", 0}, {"byteOffset", 12}, {"byteLength", 12}, {"byteStride", 4}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5121},
         {"normalized", true},
         {"count", 3},
         {"type", "VEC3"}},
        {{"bufferView", 1},
         {"componentType", 5120},
         {"normalized", true},
         {"count", 3},
         {"type", "VEC3"}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}}}}}}};
  const auto info = [&](nlohmann::json* json) {
    std::ofstream(folder_ / "a.gltf") << gltf;
    const test::ProgramRun run =
        run_trisect({"info", folder_ / "a.gltf", "--json", folder_ / "a.json"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    std::ifstream stream(folder_ / "a.json");
    *json = nlohmann::json::parse(stream)["quantisation"];
    return run.out;
  };
  nlohmann::json said;
  EXPECT_NE(info(&said).find("positions are off by up to 0.0034, normals by 0.39 degrees"),
            std::string::npos);
  EXPECT_NEAR(said["positions"], 0.5 * std::sqrt(3.0) / 255.0, 1e-15);
  EXPECT_NEAR(said["normals_degrees"], 0.39, 0.005);
  EXPECT_GT(said["phong_moved"], said["positions"]);
  // Made normals depend on all positions around.
  gltf["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
  EXPECT_EQ(info(&said).find("phong moves"), std::string::npos);
  EXPECT_NEAR(said["positions"], 0.5 * std::sqrt(3.0) / 255.0, 1e-15);
  EXPECT_TRUE(said["phong_moved"].is_null());
  // Of floats nothing is said.
  const test::ProgramRun cube =
      run_trisect({"info", test::asset_path("cube"), "--json", folder_ / "a.json"});
  EXPECT_EQ(cube.out.find("off by up to"), std::string::npos);
}

TEST_F(Program, WritesDataToStandardOutputAlone) {
  ASSERT_EQ(render({}, "a.png").exit_code, 0);
  const auto standard = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", test::asset_path("sphere-20"), "--size", "32x24"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_trisect(arguments);
  };
  const test::ProgramRun image = standard({"-o", "-"});
  EXPECT_EQ(image.exit_code, 0) << image.err;
  EXPECT_EQ(image.out, test::content_of(folder_ / "a.png"));
  EXPECT_NE(image.err.find("pixels hit"), std::string::npos);
  const test::ProgramRun figures = standard({"-o", folder_ / "b.png", "--stats", "-"});
  EXPECT_EQ(nlohmann::json::parse(figures.out)["patches"], 20);
  EXPECT_NE(figures.err.find("pixels hit"), std::string::npos);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"info", test::asset_path("cube")},
        std::vector<std::string>{"devices"},
        std::vector<std::string>{"compare", folder_ / "a.png", folder_ / "b.png"},
        std::vector<std::string>{"export", test::asset_path("cube"), "--subdivide", "1", "-o",
                                 folder_ / "c.ply"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--json", "-"});
    const test::ProgramRun run = run_trisect(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(nlohmann::json::accept(run.out)) << command[0] << run.out;
    EXPECT_NE(run.err, "") << command[0];
  }
  const test::ProgramRun both = standard({"-o", "-", "--stats", "-"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_EQ(both.err, "trisect: -: standard output takes one output.\n");
}

TEST_F(Program, IsQuietIfItIsTold) {
  const test::ProgramRun run = render({"--quiet"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out + run.err, "");
  EXPECT_EQ(files(), 1U);
  const test::ProgramRun wrong = run_trisect({"info", "-q", folder_ / "none.obj"});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_NE(wrong.err, "");
}

// What each step took, apart from what a program reads.
TEST_F(Program, SaysMoreIfItIsTold) {
  const test::ProgramRun run = render({"--verbose", "--stats", "-", "--accel", "bvh"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(nlohmann::json::accept(run.out)) << run.out;
  for (const char* part : {"read in ", "SHA-256 ", "baked in ", "subpatches", "made a tree of ",
                           "accel bvh, as asked for"}) {
    EXPECT_NE(run.err.find(part), std::string::npos) << part << run.err;
  }
}

// A model that cannot be read is found before the first is measured.
TEST_F(Program, ReadsAllModelsBeforeItMeasures) {
  for (const Words& command : {Words{"accuracy"}, Words{"bench", "speed"}}) {
    Words words = command;
    words.insert(words.end(), {test::asset_path("cube"), folder_ / "none.obj"});
    const test::ProgramRun run = run_trisect(words);
    EXPECT_EQ(run.exit_code, 3) << run.err;
    EXPECT_NE(run.err.find("none.obj"), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "") << command.back();
  }
}

TEST_F(Program, MakesTheFoldersOfItsOutputs) {
  ASSERT_EQ(render({"--stats", folder_ / "c/s.json"}, "a/b/x.png").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a/b/x.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "c/s.json"));
  const test::ProgramRun run = render({}, "c/s.json/x.png");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("c/s.json: the folder cannot be made"), std::string::npos) << run.err;
}

TEST_F(Program, SaysThatStandardOutputCannotBeWritten) {
  for (const char* command : {"info", "render -o -", "render --stats - -o x.png"}) {
    const std::string line =
        fmt::format("cd {} && {} {} {} >/dev/full 2>err", folder_.path().string(),
                    test::program_path(), command, test::asset_path("cube"));
    const int status = std::system(line.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3) << command;
    const std::string err = test::content_of(folder_ / "err");
    EXPECT_NE(err.find("trisect: standard output: cannot be written: No space"), std::string::npos)
        << err;
  }
}

TEST_F(Program, ComplainsAboutDevicesWithCode4) {
  expect_complaint(render({"--device", "99"}), 4, "no Vulkan device is called '99'");
  // The refusal lists the devices by number and name.
  const std::string listed = run_trisect({"devices"}).out;
  const std::string first = "0 " + listed.substr(3, listed.find(' ', 3) - 3);
  expect_complaint(render({"--device", "no such device"}), 4, first);
  const std::vector<std::string> no_driver{"VK_DRIVER_FILES=/nonexistent.json",
                                           "VK_ICD_FILENAMES=/nonexistent.json"};
  expect_complaint(run_trisect({"devices"}, no_driver), 4, "Vulkan");
  expect_complaint(
      run_trisect({"render", test::asset_path("cube"), "-o", folder_ / "a.png"}, no_driver), 4,
      "Vulkan");
  expect_complaint(run_trisect({"render", test::asset_path("cube"), "-o", folder_ / "a.png",
                                "--backend", "opengl"},
                               {"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json"}),
                   4, "EGL");
}

TEST_F(Program, StopsWhenInterruptedAndLeavesNothing) {
  const test::ProgramRun run = test::signal_trisect(
      {"render", test::asset_path("teapot-1000"), "-o", folder_ / "a.png", "--size", "1600x1200",
       "--runs", "100000", "--stats", folder_ / "s.json"},
      1500);
  expect_complaint(run, 130, "interrupted");
}

// Endings that can be caught, and a file that becomes too large, are told in a sentence and leave
// nothing.
TEST_F(Program, LeavesNothingHoweverItEnds) {
  const std::string render =
      fmt::format("{} render {} --size 1600x1200 --runs 100000 -o {}", test::program_path(),
                  test::asset_path("teapot-1000"), (folder_ / "a.png").string());
  const test::TemporaryFolder logs;
  const std::string err = logs / "err";
  for (const auto& [signal, code] : {std::pair("TERM", 130), {"HUP", 130}, {"QUIT", 130}}) {
    // The shell's own trap for the signal is the default, whatever started the test.
    const std::string line =
        fmt::format("timeout --preserve-status -s {} 1.5 {} >/dev/null 2>{}", signal, render, err);
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), code) << signal;
    EXPECT_EQ(test::content_of(err), "trisect: interrupted\n") << signal;
    EXPECT_EQ(files(), 0U) << signal;
  }
  std::system(fmt::format("timeout -s KILL 1.5 {} >/dev/null 2>{}", render, err).c_str());
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_TRUE(entry.path().filename().string().starts_with(".trisect-")) << entry.path();
    std::filesystem::remove(entry.path());
  }
  for (const char* name : {"a.png", "a.exr", "a.pfm"}) {
    // On the CPU: what is allowed of files is allowed of a driver's memory, too, that is one.
    const std::string line =
        fmt::format("ulimit -f 4; {} render {} --backend cpu -o {} >/dev/null 2>{}",
                    test::program_path(), test::asset_path("cube"), (folder_ / name).string(), err);
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3) << name;
    EXPECT_NE(test::content_of(err).find(name), std::string::npos) << test::content_of(err);
    EXPECT_EQ(files(), 0U) << name;
  }
}

TEST_F(Program, RefusesToOverwriteItsModel) {
  std::filesystem::copy_file(test::asset_path("cube"), folder_ / "model.png");
  const test::ProgramRun run =
      run_trisect({"render", folder_ / "model.png", "-o", folder_ / "." / "model.png"});
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_EQ(std::filesystem::file_size(folder_ / "model.png"),
            std::filesystem::file_size(test::asset_path("cube")));
}

TEST_F(Program, WritesNothingOverWhatItReads) {
  const std::string model = folder_ / "model.ply";
  ASSERT_EQ(
      run_trisect({"export", test::asset_path("cube"), "--subdivide", "1", "-o", model}).exit_code,
      0);
  const std::string before = test::content_of(model);
  const std::string picture = folder_ / "a.png";
  ASSERT_EQ(render({"--size", "8x8"}).exit_code, 0);
  const std::string pixels = test::content_of(picture);
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"export", model, "--subdivide", "2", "-o", folder_ / "." / "model.ply"},
           {"export", model, "--subdivide", "2", "-o", folder_ / "b.ply", "--json",
            folder_ / "b.ply"},
           {"info", model, "--json", model},
           {"accuracy", model, "--json", model},
           {"crosscheck", model, "--json", model},
           {"certify", model, "-o", folder_ / "b.png", "--json", folder_ / "b.png"},
           {"compare", picture, picture, "--diff", picture},
           {"bench", "speed", model, "--json", model}}) {
    const test::ProgramRun run = run_trisect(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_NE(run.err.find("are the same file."), std::string::npos) << run.err;
  }
  EXPECT_EQ(test::content_of(model), before);
  EXPECT_EQ(test::content_of(picture), pixels);
  EXPECT_EQ(files(), 2U);
}

TEST_F(Program, WorksOnAsManyThreadsAsTheEnvironmentSays) {
  const std::vector<std::string> words{
      "render", test::asset_path("cube"), "--size", "8x8", "--backend", "cpu",
      "-o",     folder_ / "a.png"};
  for (const char* wrong : {"", "0", "-1", "1025", "2x", "99999999999"}) {
    expect_complaint(run_trisect(words, {std::string("TRISECT_THREADS=") + wrong}), 2,
                     fmt::format("TRISECT_THREADS is '{}': a whole number from 1 to 1024", wrong));
  }
  const test::ProgramRun run = run_trisect(words, {"TRISECT_THREADS=3"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("CPU, 3 threads"), std::string::npos) << run.out;
}

TEST_F(Program, LastOfARepeatedOptionCounts) {
  ASSERT_EQ(render({"--size", "16x8"}, "a.exr").exit_code, 0);
  EXPECT_EQ(test::read_exr(folder_ / "a.exr").width, 16U);
}

TEST_F(Program, KeepsTheOldFileWhenItFails) {
  std::ofstream(folder_ / "a.png") << "old";
  EXPECT_EQ(render({"--device", "99"}).exit_code, 4);
  std::string text;
  std::ifstream(folder_ / "a.png") >> text;
  EXPECT_EQ(text, "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(Program, ListsDevices) {
  const test::ProgramRun run = run_trisect({"devices"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out.find("0  "), 0U) << run.out;
  EXPECT_NE(run.out.find("usable"), std::string::npos) << run.out;
}

TEST_F(Program, MeasuresTheArithmeticOfADevice) {
  const test::ProgramRun run =
      run_trisect({"devices", "--floats", "--device", "0", "--json", folder_ / "floats.json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("| a + b | 0.5 ulp | "), std::string::npos) << run.out;
  const auto json = nlohmann::json::parse(std::ifstream(folder_ / "floats.json"));
  ASSERT_EQ(json["devices"].size(), 1U);
  const auto& device = json["devices"][0];
  EXPECT_TRUE(device["usable"]);
  EXPECT_GT(device["floats"]["items"], 5000);
  EXPECT_GT(device["floats"]["add"]["ulp"], 0.49);
  EXPECT_EQ(run_trisect({"devices", "--device", "99"}).exit_code, 4);
}

TEST_F(Program, TakesADeviceByNumberAndByName) {
  EXPECT_EQ(render({"--device", "0"}).exit_code, 0);
  const std::string listed = run_trisect({"devices"}).out;
  const std::string name = listed.substr(3, listed.find(' ', 3) - 3);
  EXPECT_EQ(render({"--device", name}).exit_code, 0) << name;
}

TEST_F(Program, RendersByOpenGl) {
  ASSERT_EQ(render({"--backend", "opengl"}, "gl.exr").exit_code, 0);
  ASSERT_EQ(render({"--backend", "opengl", "--gl-path", "fragment"}, "quad.exr").exit_code, 0);
  ASSERT_EQ(render({}, "vk.exr").exit_code, 0);
  EXPECT_EQ(run_trisect({"compare", folder_ / "vk.exr", folder_ / "gl.exr"}).exit_code, 0);
  EXPECT_EQ(run_trisect({"compare", folder_ / "vk.exr", folder_ / "quad.exr"}).exit_code, 0);
  EXPECT_EQ(render({"--gl-path", "sideways"}).exit_code, 2);
}

TEST_F(Program, TellsItsVersionAndHelps) {
  const test::ProgramRun version = run_trisect({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out, "trisect " TRISECT_VERSION "\n");
  const test::ProgramRun help = run_trisect({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"render", "crosscheck", "compare", "devices", "--version"}) {
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  }
  const test::ProgramRun render_help = run_trisect({"render", "--help"}, {"COLUMNS=60"});
  EXPECT_EQ(render_help.exit_code, 0);
  std::istringstream lines(render_help.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 60U) << line;
  for (const char* word :
       {"MODEL", "--output", "--size", "--surface", "--alpha", "--solver", "--rank", "--eye",
        "--target", "--up", "--fov", "--device", "--validation", "--runs", "--stats"}) {
    EXPECT_NE(render_help.out.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace trisect
