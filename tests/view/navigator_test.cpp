// Camera motion, resolution of moving frames and script files, without a window.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/glm.hpp>

#include "app/base/error.h"
#include "app/view/navigator.h"
#include "app/view/pacer.h"
#include "app/view/script.h"
#include "app/view/window.h"
#include "tests/support/temporary_folder.h"

namespace trisect::view {
namespace {

using glm::dvec3;

// More than the rounding errors of a few rotations in doubles.
constexpr double kClose = 1e-12;

Camera camera() {
  return {dvec3(0.0, 0.0, 5.0), dvec3(0.0), dvec3(0.0, 1.0, 0.0), 45.0};
}

void expect_close(const dvec3& a, const dvec3& b) {
  EXPECT_LT(glm::distance(a, b), kClose) << a.x << " " << a.y << " " << a.z;
}

TEST(Navigator, WalksByItsSpeed) {
  Navigator navigator(camera(), 2.0);
  EXPECT_FALSE(navigator.move({}, 1.0));
  EXPECT_TRUE(navigator.move({dvec3(1.0, 0.0, 0.0), {}, 0.0}, 0.5));
  expect_close(navigator.camera().eye, dvec3(1.0, 0.0, 5.0));
  expect_close(navigator.camera().target, dvec3(1.0, 0.0, 0.0));
  navigator.move({dvec3(0.0, 1.0, 1.0), {}, 0.0}, 1.0);
  expect_close(navigator.camera().eye, dvec3(1.0, 2.0, 3.0));
  const double before = navigator.speed();
  EXPECT_FALSE(navigator.move({dvec3(0.0), {}, 2.0}, 1.0));
  EXPECT_GT(navigator.speed(), before);
}

TEST(Navigator, TurnsInItsPlace) {
  Navigator navigator(camera(), 1.0);
  // A quarter turn to the right: from -z to +x.
  navigator.move({dvec3(0.0), {std::acos(0.0), 0.0}, 0.0}, 1.0);
  expect_close(navigator.camera().eye, dvec3(0.0, 0.0, 5.0));
  expect_close(navigator.camera().target, dvec3(5.0, 0.0, 5.0));
  navigator.move({dvec3(0.0), {0.0, 0.5}, 0.0}, 1.0);
  EXPECT_GT(navigator.camera().target.y, 0.0);
}

TEST(Navigator, NeverLooksAlongItsUpVector) {
  for (const bool orbits : {false, true}) {
    Navigator navigator(camera(), 1.0);
    navigator.set_orbits(orbits);
    for (int i = 0; i < 100; ++i) navigator.move({dvec3(0.0), {0.1, 0.3}, 0.0}, 1.0);
    for (int i = 0; i < 250; ++i) {
      navigator.move({dvec3(0.0), {0.0, i < 125 ? 0.3 : -0.3}, 0.0}, 1.0);
      const Camera& now = navigator.camera();
      const dvec3 ahead = glm::normalize(now.target - now.eye);
      EXPECT_LT(std::abs(ahead.y), std::cos(0.005));
    }
  }
}

TEST(Navigator, OrbitsAtItsDistance) {
  Navigator navigator(camera(), 1.0);
  navigator.set_orbits(true);
  navigator.move({dvec3(0.0), {0.7, 0.2}, 0.0}, 1.0);
  expect_close(navigator.camera().target, dvec3(0.0));
  EXPECT_NEAR(glm::length(navigator.camera().eye), 5.0, kClose);
  navigator.move({dvec3(0.0), {}, 1.0}, 1.0);
  EXPECT_LT(glm::length(navigator.camera().eye), 5.0);
  EXPECT_GT(glm::length(navigator.camera().eye), 4.0);
}

TEST(Pacer, HoldsTheTimeAskedFor) {
  Pacer pacer;
  EXPECT_LT(pacer.scale(33.0), 1.0);
  // Frames that take full_ms for all pixels of the window, and 5 ms for everything else.
  for (const double full_ms : {5.0, 40.0, 400.0, 100000.0}) {
    Pacer learning;
    for (int i = 0; i < 30; ++i) {
      const double scale = learning.scale(33.0);
      learning.record(scale, full_ms * scale * scale, 5.0);
    }
    const double scale = learning.scale(33.0);
    if (full_ms <= 28.0) {
      EXPECT_EQ(scale, 1.0);
    } else if (full_ms < 1000.0) {
      EXPECT_LE(full_ms * scale * scale, 28.0);
      // The next larger scale would take too long.
      EXPECT_GT(full_ms * (scale + 1.0 / 32.0) * (scale + 1.0 / 32.0), 28.0);
    } else {
      EXPECT_EQ(scale, Pacer::kLeast);
    }
  }
}

TEST(Pacer, FollowsACostThatChanges) {
  Pacer pacer;
  const auto see = [&](double full_ms, int frames) {
    for (int i = 0; i < frames; ++i) {
      const double scale = pacer.scale(33.0);
      pacer.record(scale, full_ms * scale * scale, 1.0);
    }
  };
  see(10.0, 10);
  EXPECT_EQ(pacer.scale(33.0), 1.0);
  // Each frame halves the error of the estimate: after five it is small.
  see(300.0, 1);
  EXPECT_LT(pacer.scale(33.0), 0.5);
  see(300.0, 4);
  EXPECT_NEAR(pacer.scale(33.0), std::sqrt(32.0 / 300.0), 2.0 / 32.0);
  see(10.0, 10);
  EXPECT_EQ(pacer.scale(33.0), 1.0);
}

class Script : public ::testing::Test {
 protected:
  std::vector<ScriptStep> read(const std::string& text) {
    std::ofstream(folder_ / "script") << text;
    return read_script(folder_ / "script");
  }

  // The message of the error, empty if there is none.
  std::string complaint(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(Script, IsInTheOrderOfTime) {
  const auto steps =
      read("# a walk\n\n1.5 quit\n0.25 hold w 0.5\n0.25 flags --fov 60 --eye 1,2,3\n");
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[0].command, "hold");
  EXPECT_EQ(steps[0].argument, "w 0.5");
  EXPECT_EQ(steps[1].argument, "--fov 60 --eye 1,2,3");
  EXPECT_EQ(steps[2].command, "quit");
  EXPECT_EQ(steps[2].seconds, 1.5);
}

TEST_F(Script, SaysWhatIsNone) {
  EXPECT_NE(complaint("0 quit\nsoon quit\n").find("line 2: 'soon' is not a number"),
            std::string::npos);
  EXPECT_NE(complaint("1 fly\n").find("'fly' is not a command"), std::string::npos);
  EXPECT_NE(complaint("-1 quit\n").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("1 hold ctrl 2\n").find("'ctrl' is not a key"), std::string::npos);
  EXPECT_NE(complaint("1 hold w long\n").find("seconds"), std::string::npos);
  EXPECT_NE(complaint("1 shown nothing\n").find("'nothing' is not an output"), std::string::npos);
  EXPECT_NE(complaint("1 size 0x9\n").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("1 flags --fow 3\n").find("--fow"), std::string::npos);
}

TEST(Keys, HaveNames) {
  EXPECT_EQ(key_named("w"), GLFW_KEY_W);
  EXPECT_EQ(key_named("8"), GLFW_KEY_8);
  EXPECT_EQ(key_named("space"), GLFW_KEY_SPACE);
  EXPECT_EQ(key_named("what"), -1);
}

}  // namespace
}  // namespace trisect::view
