// Sequences of frames and images in parts, by the program.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/picture/image_reader.h"
#include "tests/support/file_content.h"
#include "tests/support/program.h"
#include "tests/support/run_program.h"

namespace trisect {
namespace {

using test::run_trisect;
using Words = std::vector<std::string>;

class Sequences : public test::Program {
 protected:
  test::ProgramRun render_frames(const Words& more, const std::string& name = "{frame}.png") {
    Words words{"--turntable", "4"};
    words.insert(words.end(), more.begin(), more.end());
    return render(words, name);
  }

  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      found.insert(entry.path().filename());
    }
    return found;
  }

  [[nodiscard]] std::string content(const std::string& name) const {
    return test::content_of(folder_ / name);
  }
};

TEST_F(Sequences, HaveAFileForEachFrame) {
  const test::ProgramRun run =
      render_frames({"--eye", "1,2,3", "--stats", folder_ / "{frame}.json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(names(), (std::set<std::string>{"0000.png", "0000.json", "0001.png", "0001.json",
                                            "0002.png", "0002.json", "0003.png", "0003.json"}));
  EXPECT_NE(content("0000.png"), content("0002.png"));
  EXPECT_EQ(nlohmann::json::parse(content("0002.json"))["frame"], 2);
  // The first frame is the picture without a path, and each can be made again on its own.
  ASSERT_EQ(render({"--eye", "1,2,3"}, "alone.png").exit_code, 0);
  EXPECT_EQ(content("0000.png"), content("alone.png"));
  ASSERT_EQ(run_trisect({"render", "--from", folder_ / "0003.png", "-o", folder_ / "again.png"})
                .exit_code,
            0);
  EXPECT_EQ(content("0003.png"), content("again.png"));
}

TEST_F(Sequences, FollowAPath) {
  std::ofstream(folder_ / "path.json")
      << R"({"keys": [{"frame": 0, "eye": [0, 0, 3]}, {"frame": 2, "eye": [3, 0, 0], "fov": 30}]})";
  const test::ProgramRun run =
      render({"--camera-path", folder_ / "path.json", "--frames", "1:2"}, "p-{frame}-{frame}.png");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(names(), (std::set<std::string>{"path.json", "p-0001-0001.png", "p-0002-0002.png"}));
  ASSERT_EQ(render({"--eye", "3,0,0", "--fov", "30"}, "alone.png").exit_code, 0);
  EXPECT_EQ(content("p-0002-0002.png"), content("alone.png"));
}

TEST_F(Sequences, GoOnWithWhatIsMissing) {
  ASSERT_EQ(render_frames({"--frames", "1:2"}).exit_code, 0);
  const std::string whole = content("0001.png");
  // A torn file is no finished frame.
  std::ofstream(folder_ / "0002.png") << content("0002.png").substr(0, 300);
  const auto written = std::filesystem::last_write_time(folder_ / "0001.png");
  const test::ProgramRun run = render_frames({"--resume"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "0001.png"), written);
  EXPECT_NE(run.out.find("0001.png is there"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("0002.png: "), std::string::npos) << run.out;
  EXPECT_EQ(names().size(), 4U);
  EXPECT_GT(content("0002.png").size(), 300U);
  const test::ProgramRun all = render_frames({"--resume"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_NE(all.out.find("0003.png is there"), std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("pixels hit"), std::string::npos) << all.out;
  // Frames of another view are no frames of this sequence.
  const test::ProgramRun other = render_frames({"--resume", "--fov", "20"});
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_NE(other.err.find("0000.png: is there already, with another "), std::string::npos)
      << other.err;
  EXPECT_EQ(content("0001.png"), whole);
  EXPECT_EQ(render_frames({"--fov", "20"}).exit_code, 0);
  EXPECT_NE(content("0001.png"), whole);
  // An EXR without colours is whole, too.
  ASSERT_EQ(render_frames({"--aov", "Z"}, "{frame}.exr").exit_code, 0);
  const test::ProgramRun deep = render_frames({"--aov", "Z", "--resume"}, "{frame}.exr");
  EXPECT_EQ(deep.exit_code, 0) << deep.err;
  EXPECT_NE(deep.out.find("0003.exr is there"), std::string::npos) << deep.out;
  EXPECT_EQ(deep.out.find("pixels hit"), std::string::npos) << deep.out;
}

// Neither a part of a frame nor one of other counts is the frame.
TEST_F(Sequences, GoOnWithWholeFramesOnly) {
  ASSERT_EQ(render_frames({"--tile", "0,0,32,10"}).exit_code, 0);
  const test::ProgramRun whole = render_frames({"--resume"});
  EXPECT_EQ(whole.exit_code, 3);
  EXPECT_NE(whole.err.find("0000.png: is there already, with another tile"), std::string::npos)
      << whole.err;
  ASSERT_EQ(render_frames({"--evals", "--accel", "list"}, "{frame}.exr").exit_code, 0);
  EXPECT_EQ(render_frames({"--evals", "--accel", "bvh", "--resume"}, "{frame}.exr").exit_code, 3);
  ASSERT_EQ(render_frames({"--accel", "list"}, "x{frame}.exr").exit_code, 0);
  EXPECT_EQ(render_frames({"--accel", "bvh", "--resume"}, "x{frame}.exr").exit_code, 0);
}

// A model that the first frame sees from its end stays in the picture all the way around.
TEST_F(Sequences, SeeAllOfTheModelFromEverywhere) {
  std::ofstream(folder_ / "long.obj") << "v 0 -1 -10\nv 0 -1 10\nv 0 1 10\nv 0 1 -10\nv 1 0 0\n"
                                         "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 4 3 2 1\n";
  const test::ProgramRun run =
      run_trisect({"render", folder_ / "long.obj", "--surface", "flat", "--turntable", "8",
                   "--size", "32x64", "-o", folder_ / "{frame}.exr"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name : {"0000.exr", "0001.exr", "0002.exr", "0005.exr"}) {
    const Frame frame = read_image(folder_ / name);
    EXPECT_GT(frame.hits(), 5U) << name;
    for (std::size_t y = 0; y < 64; ++y) {
      EXPECT_EQ(frame.colors[y * 32].w + frame.colors[y * 32 + 31].w, 0.0F) << name;
    }
  }
}

TEST_F(Sequences, FindABadCameraBeforeTheFirstFrame) {
  const std::string path = folder_ / "path.json";
  std::ofstream(path)
      << R"({"keys": [{"frame": 0, "up": [0, 1, 0]}, {"frame": 2, "up": [0, -1, 0]}]})";
  const test::ProgramRun run = render({"--camera-path", path}, "{frame}.png");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("path.json: in frame 1 the camera looks nowhere"), std::string::npos)
      << run.err;
  EXPECT_EQ(files(), 1U);
  const test::ProgramRun folder = render({"--camera-path", folder_.path().string()}, "{frame}.png");
  EXPECT_EQ(folder.exit_code, 3);
  EXPECT_NE(folder.err.find("cannot be read"), std::string::npos) << folder.err;
}

TEST_F(Sequences, RefuseOptionsThatDoNotGoTogether) {
  expect_complaint(render({"--turntable", "4"}), 2, "has no {frame}");
  expect_complaint(render_frames({"--stats", folder_ / "s.json"}), 2, "s.json has no {frame}");
  expect_complaint(render_frames({}, "../" + folder_.path().filename().string() + "/x.png"), 2,
                   "has no {frame}");
  expect_complaint(render_frames({"--runs", "3"}), 2, "--runs");
  expect_complaint(render_frames({"--frames", "3:4"}), 2, "the last frame is 3, not 4");
  for (const char* frames : {"x", "1:", ":1", "2:1", "1:2:3", "-1", "1.5"}) {
    expect_complaint(render_frames({std::string("--frames=") + frames}), 2, "--frames: '");
  }
  expect_complaint(render({"--frames", "0"}), 2, "--frames: without --turntable");
  expect_complaint(render({"--resume"}), 2, "--resume: without --turntable");
  expect_complaint(render({"--turntable", "0"}, "{frame}.png"), 2, "--turntable");
  expect_complaint(render_frames({"--camera-path", "p.json"}), 2, "one of them");
  expect_complaint(render({"--camera-path", "none.json"}, "{frame}.png"), 3, "none.json");
}

class Parts : public Sequences {
 protected:
  // Renders the image whole and in parts, and expects the parts put together to be the whole, byte
  // for byte.
  void expect_stitched(const Words& options, const std::string& ending) {
    const auto rendered = [&](const std::string& name, const Words& more) {
      Words words = options;
      words.insert(words.end(), more.begin(), more.end());
      const test::ProgramRun run = render(words, name + ending);
      EXPECT_EQ(run.exit_code, 0) << run.err;
      return folder_ / (name + ending);
    };
    // Neither the places nor the sizes are multiples of a workgroup's, and two parts overlap.
    Words stitch{"stitch",
                 rendered("a", {"--tile", "0,0,13,24"}),
                 rendered("b", {"--tile", "13,0,19,11"}),
                 rendered("c", {"--tile", "12,11,20,13"}),
                 "-o",
                 folder_ / ("stitched" + ending)};
    const test::ProgramRun run = run_trisect(stitch);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    rendered("whole", {});
    EXPECT_EQ(content("stitched" + ending), content("whole" + ending))
        << fmt::format("{}", fmt::join(options, " "));
  }
};

TEST_F(Parts, MakeTheWholeImage) {
  expect_stitched({"--accel", "tiles", "--background", "transparent", "--spp", "4"}, ".png");
  expect_stitched({}, ".exr");
  expect_stitched({"--accel", "tiles", "--shadows", "--aov", "color,Z,N,P,patch"}, ".exr");
  expect_stitched({"--accel", "bvh", "--spp", "4", "--surface", "sphere"}, ".exr");
  expect_stitched({"--accel", "list", "--preset", "thesis"}, ".exr");
  expect_stitched({"--backend", "opengl"}, ".exr");
  expect_stitched({"--backend", "cpu"}, ".png");
  expect_stitched({"--backend", "oracle", "--shadows"}, ".exr");
}

TEST_F(Parts, AreOfOneImage) {
  const auto part = [&](const std::string& name, const std::string& tile, const Words& more = {}) {
    Words words{"--tile", tile};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(render(words, name).exit_code, 0) << name;
    return folder_ / name;
  };
  const auto expect_refused = [&](const Words& parts, int code, const std::string& why) {
    Words words{"stitch", "-o", folder_ / "x.exr"};
    words.insert(words.end(), parts.begin(), parts.end());
    const test::ProgramRun run = run_trisect(words);
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.exr"));
  };
  const std::string left = part("left.exr", "0,0,16,24");
  const std::string right = part("right.exr", "17,0,15,24");
  expect_refused({left}, 3, "left.exr: neither it nor another part has the pixel (16, 0)");
  expect_refused({left, right}, 3, "left.exr: neither it nor another part has the pixel (16, 0)");
  expect_refused({left, part("other.exr", "16,0,16,24", {"--fov", "30"})}, 3, "with another ");
  expect_refused({left, part("z.exr", "16,0,16,24", {"--aov", "Z"})}, 3, "with another aov");
  expect_refused({left, part("a.png", "16,0,16,24")}, 2, "a.png: is not of the format of");
  expect_refused({left, folder_ / "none.exr"}, 3, "none.exr");
  expect_refused({left, folder_ / "x.exr"}, 2, "are the same file");
  EXPECT_EQ(run_trisect({"stitch", folder_ / "a.png", "-o", folder_ / "x.pfm"}).exit_code, 2);
  // One that says that its image is larger than there is memory for.
  Frame small;
  small.resize(4, 4, false);
  ImageContents contents;
  contents.attributes = {{"size", std::string("4000000000x4000000000")},
                         {"tile", std::string("0,0,4,4")}};
  save_image(small, folder_ / "huge.png", contents);
  contents.place = FramePlace{0, 0, 200000, 200000};
  save_image(small, folder_ / "huge.exr", contents);
  for (const char* name : {"huge.png", "huge.exr"}) {
    const std::string whole_name = std::string("whole") + (folder_ / name).extension().string();
    const test::ProgramRun huge =
        run_trisect({"stitch", folder_ / name, "-o", folder_ / whole_name});
    EXPECT_EQ(huge.exit_code, 3) << huge.err;
    EXPECT_NE(huge.err.find("of more than 16384 pixels a side"), std::string::npos) << huge.err;
  }
  // A picture that does not say where it belongs.
  const test::ProgramRun whole = run_trisect({"compare", left, left, "--diff", folder_ / "d.png"});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const test::ProgramRun run = run_trisect({"stitch", folder_ / "d.png", "-o", folder_ / "x.png"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("does not say which part"), std::string::npos) << run.err;
}

TEST_F(Parts, LieInTheImage) {
  for (const char* tile : {"", "1,2,3", "0,0,0,1", "0,0,33,1", "31,0,2,1", "0,24,1,1", "-1,0,1,1",
                           "4294967295,0,2,1", "0,0,1,1,1", "0,0,1,4294967295"}) {
    expect_complaint(render({std::string("--tile=") + tile}), 2, "--tile: ");
  }
  expect_complaint(render({"--tile", "0,0,1,1", "--backend", "opengl", "--gl-path", "fragment"}), 2,
                   "--gl-path compute");
}

}  // namespace
}  // namespace trisect
