// The viewer in a real window, on an X display of the test's own, worked by keyboard and mouse.
// Everything runs under Vulkan's validation layer, whose messages make the exit code 70.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/picture/image_reader.h"
#include "tests/support/file_content.h"
#include "tests/support/frame_difference.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/x_display.h"

namespace trisect {
namespace {

using namespace std::chrono_literals;

// Asks four times a second until it is so, for a minute at most.
void wait_until(const std::function<bool()>& is_so) {
  for (int i = 0; i < 240 && !is_so(); ++i) std::this_thread::sleep_for(250ms);
}

class View : public ::testing::Test {
 protected:
  // Runs `trisect view` with this script until it ends.
  test::ProgramRun view(const std::string& script, std::vector<std::string> more = {},
                        const std::string& model = test::asset_path("sphere-20")) {
    std::ofstream(folder_ / "script") << script;
    std::vector<std::string> arguments{"view",        model,     "--script", folder_ / "script",
                                       "--size",      "320x240", "--stats",  folder_ / "stats.json",
                                       "--validation"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_trisect(arguments, environment());
  }

  [[nodiscard]] std::vector<std::string> environment() const {
    std::vector<std::string> all{display_.environment(),
                                 "XDG_CACHE_HOME=" + (folder_ / "cache").string()};
    // Mesa's shader cache stays where it is: without it every kernel takes a second to compile.
    const char* home = std::getenv("HOME");
    const char* kept = std::getenv("XDG_CACHE_HOME");
    if (kept != nullptr) {
      all.push_back(std::string("MESA_SHADER_CACHE_DIR=") + kept);
    } else if (home != nullptr) {
      all.push_back(std::string("MESA_SHADER_CACHE_DIR=") + home + "/.cache");
    }
    return all;
  }

  [[nodiscard]] nlohmann::json stats() const {
    std::ifstream file(folder_ / "stats.json");
    return nlohmann::json::parse(file);
  }

  // Expects the bytes of the file to be those that `trisect render` writes with these options.
  void expect_rendered(const std::string& file, std::vector<std::string> options) {
    const std::string other = folder_ / "rendered.png";
    options.insert(options.begin(), "render");
    options.insert(options.end(), {"-o", other});
    const test::ProgramRun run = test::run_trisect(options);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::string expected = test::content_of(other);
    ASSERT_GT(expected.size(), 500U);
    EXPECT_TRUE(test::content_of(file) == expected) << file;
  }

  test::TemporaryFolder folder_;
  test::XDisplay display_;
};

TEST_F(View, SavesWhatRenderDoes) {
  const std::string flags = "--size 160x120 --eye 1,0.5,3 --target 0.1,0,0 --surface sphere";
  const std::string saved = folder_ / "saved.png";
  const std::string last = folder_ / "last.png";
  const test::ProgramRun run = view("0 flags " + flags + "\n0.4 save " + saved +
                                        "\n0.5 flags --size 64x48 --spp 4 --eye 2,1,3\n1 quit\n",
                                    {"--screenshot", last});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  expect_rendered(saved, {test::asset_path("sphere-20"), "--size", "160x120", "--eye", "1,0.5,3",
                          "--target", "0.1,0,0", "--surface", "sphere"});
  expect_rendered(
      last, {test::asset_path("sphere-20"), "--size", "64x48", "--spp", "4", "--eye", "2,1,3"});
}

TEST_F(View, TakesEveryControl) {
  const std::string controls =
      "0 flags --surface flat\n0.3 flags --surface sphere --shell height\n"
      "0.6 flags --solver bisect --rank 12\n0.9 flags --accel list\n1.2 flags --accel bvh\n"
      "1.5 flags --shadows --light 1,0.2,0\n1.8 flags --spp 4 --alpha 0.3\n"
      "2.1 shown shading normal\n2.3 shown geometric normal\n2.5 shown depth\n2.7 shown patch\n"
      "2.9 shown u v\n3.1 shown evaluations\n3.4 error\n3.6 press h\n3.7 press tab\n"
      "3.8 press tab\n3.9 press o\n4 hold a 0.3\n4.3 press f\n5 quit\n";
  // The first time kernels may have to be made, and the next control comes before they are.
  for (int i = 0; i < 2; ++i) {
    const test::ProgramRun run = view(controls);
    ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  }
  EXPECT_GT(stats()["frames"].get<int>(), 5);
}

// The picture has to come to an end before the script begins, whatever the script is to do then.
TEST_F(View, BeginsAScriptAfterAPictureThatTakesItsTime) {
  const test::ProgramRun run =
      view("0 quit\n", {"--size", "800x600", "--shadows"}, test::asset_path("torus"));
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
}

TEST_F(View, SurvivesEverySize) {
  std::string script;
  for (int i = 0; i < 20; ++i) {
    script += std::to_string(0.1 * i) + " size " + std::to_string(100 + 37 * i) + "x" +
              std::to_string(500 - 23 * i) + "\n";
  }
  const test::ProgramRun run = view(script + "2.5 size 1x1\n2.8 size 320x240\n3.2 quit\n");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
}

TEST_F(View, KeepsTheOldModelIfANewOneIsBroken) {
  const std::string broken = folder_ / "broken.obj";
  std::ofstream(broken) << "v 0 0 nan\n";
  const std::string saved = folder_ / "saved.png";
  const test::ProgramRun run =
      view("0 open " + broken + "\n0.5 open " + (folder_ / "none.obj").string() +
           "\n1 flags --size 80x60 --eye 0,0,4 --target 0,0,0\n1.5 save " + saved + "\n2 quit\n");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  expect_rendered(saved, {test::asset_path("sphere-20"), "--size", "80x60", "--eye", "0,0,4",
                          "--target", "0,0,0"});
}

TEST_F(View, OpensAnotherModel) {
  const std::string saved = folder_ / "saved.png";
  const test::ProgramRun run =
      view("0 open " + test::asset_path("cube") +
           "\n0.5 flags --size 80x60 --eye 1,2,5\n0.6 save " + saved + "\n0.8 quit\n");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  expect_rendered(saved, {test::asset_path("cube"), "--size", "80x60", "--eye", "1,2,5"});
  EXPECT_NE(test::content_of(folder_ / "cache" / "trisect" / "recent-models").find("cube.obj"),
            std::string::npos);
}

TEST_F(View, ReloadsShadersAndKeepsTheOldOnesIfTheyAreBroken) {
  display_.manage_windows();
  const std::filesystem::path shaders = folder_ / "shaders";
  std::filesystem::copy(TRISECT_SOURCES "/shaders", shaders);
  auto run = std::async(std::launch::async, [&] {
    return view("0 press tab\n120 quit\n", {"--shaders", shaders, "--watch"});
  });
  const std::string window = display_.window_called("trisect: sphere-20");
  const auto middle = [&] { return display_.pixel(window, 160, 120); };
  const auto is_blue = [](const std::string& pixel) {
    return pixel.find("0000FF") != std::string::npos;
  };
  EXPECT_FALSE(is_blue(middle()));
  // A shading that paints the model blue.
  std::string shading = test::content_of(shaders / "shading.glsl");
  const std::string begin = "vec3 n = normalize3(normal);\n  real lambert";
  ASSERT_NE(shading.find(begin), std::string::npos);
  shading.insert(shading.find(begin), "return vec3(0.0, 0.0, 1.0);\n  ");
  std::ofstream(shaders / "shading.glsl") << shading;
  // glslang and the driver take a while to compile it.
  wait_until([&] { return is_blue(middle()); });
  EXPECT_TRUE(is_blue(middle()));
  std::ofstream(shaders / "shading.glsl") << "this is no shader\n";
  std::this_thread::sleep_for(1500ms);
  EXPECT_TRUE(is_blue(middle()));
  display_.xdotool("key alt+F4");
  const test::ProgramRun done = run.get();
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
}

TEST_F(View, WalksByRealKeysAndTurnsByTheMouse) {
  display_.manage_windows();
  const std::string saved = folder_ / "saved.png";
  // The program ends when the window manager closes the window, or by the script if the test fails.
  auto run = std::async(std::launch::async, [&] {
    return view("0 press tab\n120 quit\n", {"--screenshot", saved});
  });
  const std::string window = display_.window_called("trisect: sphere-20");
  const auto picture = [&] { return display_.pixel(window, 160, 120, 100); };
  // Waits until the picture is refined, which is when it stops changing.
  const auto at_rest = [&] {
    std::string last;
    wait_until([&] { return std::exchange(last, picture()) == last; });
    return last;
  };
  display_.xdotool("mousemove --window " + window + " 200 120");
  const std::string first = at_rest();
  display_.xdotool("keydown w");
  wait_until([&] { return picture() != first; });
  display_.xdotool("keyup w");
  const std::string walked = at_rest();
  EXPECT_NE(walked, first);
  display_.xdotool("mousedown 1");
  wait_until([&] {
    display_.xdotool("mousemove_relative 8 3");
    return picture() != walked;
  });
  display_.xdotool("mouseup 1");
  const std::string turned = at_rest();
  EXPECT_NE(turned, walked);
  display_.xdotool("key h");
  wait_until([&] { return picture() != turned; });
  EXPECT_NE(picture(), turned);
  display_.xdotool("key alt+F4");
  const test::ProgramRun done = run.get();
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_GE(stats()["moving_frames"].get<int>(), 2);
  const std::string still = folder_ / "still.png";
  ASSERT_EQ(
      test::run_trisect({"render", test::asset_path("sphere-20"), "--size", "320x240", "-o", still})
          .exit_code,
      0);
  EXPECT_FALSE(test::content_of(saved) == test::content_of(still));
}

TEST_F(View, IsMinimisedRestoredAndClosed) {
  display_.manage_windows();
  const std::string name = "trisect: cube";
  auto run = std::async(std::launch::async, [&] {
    return view("0 press tab\n120 quit\n", {}, test::asset_path("cube"));
  });
  const std::string window = display_.window_called(name);
  // Refined: as it is for two seconds.
  std::string before;
  int same = 0;
  wait_until([&] {
    same = std::exchange(before, display_.pixel(window, 160, 120, 100)) == before ? same + 1 : 0;
    return same == 8;
  });
  // openbox may overlook a request, so each is made until it is heard.
  wait_until([&] {
    display_.xdotool("windowminimize " + window);
    return !display_.shows(name);
  });
  EXPECT_FALSE(display_.shows(name));
  wait_until([&] {
    display_.xdotool("windowmap " + window);
    display_.xdotool("windowactivate " + window);
    return display_.shows(name);
  });
  std::string after;
  wait_until([&] { return (after = display_.pixel(window, 160, 120, 100)) == before; });
  EXPECT_EQ(after, before);
  display_.xdotool("key alt+F4");
  const test::ProgramRun done = run.get();
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
}

// A window that draws all the time would draw about a hundred frames in three seconds.
TEST_F(View, DrawsNothingAtRest) {
  const test::ProgramRun run = view("3 quit\n");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  const int frames = stats()["frames"].get<int>();
  EXPECT_GE(frames, 3);
  EXPECT_LE(frames, 20);
}

// A session may end with the window open.
TEST_F(View, EndsWithTheDisplay) {
  const std::string saved = folder_ / "saved.png";
  auto run = std::async(std::launch::async, [&] {
    return view("120 quit\n", {"--screenshot", saved}, test::asset_path("cube"));
  });
  EXPECT_FALSE(display_.window_called("trisect: cube").empty());
  display_.end();
  const test::ProgramRun done = run.get();
  EXPECT_EQ(done.exit_code, 4) << done.out << done.err;
  EXPECT_EQ(done.err, "trisect: the display has gone, and the window with it.\n");
  EXPECT_FALSE(std::filesystem::exists(saved));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".trisect-")) << entry.path();
  }
}

TEST_F(View, EndsAfterSoManyFrames) {
  const test::ProgramRun run =
      test::run_trisect({"view", test::asset_path("cube"), "--frames", "5", "--size", "160x120",
                         "--screenshot", folder_ / "a.png", "--validation"},
                        environment());
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("5 frames"), std::string::npos) << run.out;
  expect_rendered(folder_ / "a.png", {test::asset_path("cube"), "--size", "160x120"});
}

TEST_F(View, SaysWhatItLacks) {
  const auto expect = [&](const test::ProgramRun& run, int code, const std::string& part) {
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  };
  expect(test::run_trisect({"view"}, {"DISPLAY=", "WAYLAND_DISPLAY="}), 4, "needs a display");
  expect(test::run_trisect({"view", "none.obj"}, environment()), 3, "none.obj");
  expect(test::run_trisect({"view", "--script", "none"}, environment()), 3, "none");
  expect(test::run_trisect({"view", "--screenshot", "a.jpg"}, environment()), 2,
         ".png, .exr or .pfm");
  expect(test::run_trisect({"view", "--accel", "tiles", "--solver", "bisect"}, environment()), 2,
         "--accel tiles");
  expect(test::run_trisect({"view", "--device", "nobody"}, environment()), 4, "nobody");
}

}  // namespace
}  // namespace trisect
