// The camera by states of keys and mouse, without a window.
#include "app/view/camera_control.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

namespace trisect::view {
namespace {

using glm::dvec2;
using glm::dvec3;

// Far less than any motion of these tests, far more than their rounding errors.
constexpr double kSmallMotion = 1e-9;

class CameraControlTest : public ::testing::Test {
 protected:
  CameraControlTest() {
    control_.set({dvec3(0.0, 0.0, 5.0), dvec3(0.0), dvec3(0.0, 1.0, 0.0), 45.0}, 2.0);
  }

  void move(const ControlState& state, double seconds = 0.05) {
    now_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    control_.move(state, now_);
  }

  // The cursor's state with the button up or down.
  static ControlState at(double x, double y, bool button_is_down) {
    ControlState state;
    state.cursor = dvec2(x, y);
    state.button_is_down = button_is_down;
    return state;
  }

  [[nodiscard]] dvec3 eye() const { return control_.camera().eye; }
  [[nodiscard]] dvec3 target() const { return control_.camera().target; }
  [[nodiscard]] bool has_turned() const { return glm::length(target()) > kSmallMotion; }

  Clock::time_point now_{std::chrono::hours(1)};
  CameraControl control_{now_};
};

TEST_F(CameraControlTest, WalksWhileKeysAreHeld) {
  ControlState state;
  state.keys.ahead = true;
  move(state);
  // The speed is the radius of the scene, 2, in a second.
  EXPECT_LT(glm::distance(eye(), dvec3(0.0, 0.0, 4.9)), kSmallMotion);
  move({});
  EXPECT_LT(glm::distance(eye(), dvec3(0.0, 0.0, 4.9)), kSmallMotion);
}

TEST_F(CameraControlTest, OppositeKeysCancel) {
  EXPECT_EQ(steps_of({.left = true, .up = true, .back = true}), dvec3(-1.0, 1.0, -1.0));
  EXPECT_EQ(steps_of({.right = true, .down = true, .ahead = true}), dvec3(1.0, -1.0, 1.0));
  EXPECT_EQ(steps_of({true, true, true, true, true, true}), dvec3(0.0));
}

TEST_F(CameraControlTest, DoesNotJumpAfterAPause) {
  ControlState state;
  state.keys.right = true;
  move(state, 60.0);
  EXPECT_LT(glm::distance(eye(), dvec3(0.2, 0.0, 5.0)), kSmallMotion);
}

TEST_F(CameraControlTest, TheWheelSetsTheSpeed) {
  ControlState state;
  state.keys.ahead = true;
  control_.turn_wheel(1.0);
  control_.turn_wheel(1.0);
  move({});
  EXPECT_LT(glm::distance(eye(), dvec3(0.0, 0.0, 5.0)), kSmallMotion);
  move(state);
  EXPECT_LT(glm::distance(eye(), dvec3(0.0, 0.0, 5.0 - 0.1 * 1.25 * 1.25)), kSmallMotion);
  // Each step counts once.
  move(state);
  EXPECT_LT(glm::distance(eye(), dvec3(0.0, 0.0, 5.0 - 0.2 * 1.25 * 1.25)), kSmallMotion);
}

TEST_F(CameraControlTest, TurnsWhileTheButtonIsDown) {
  move(at(100.0, 100.0, false));
  move(at(150.0, 100.0, false));
  EXPECT_FALSE(has_turned());
  move(at(160.0, 100.0, true));
  EXPECT_TRUE(control_.is_turning());
  // Pressing alone does not turn.
  EXPECT_FALSE(has_turned());
  move(at(260.0, 100.0, true));
  // 100 pixels of 0.004 radians to the right.
  EXPECT_LT(glm::distance(target(), dvec3(5.0 * std::sin(0.4), 0.0, 5.0 - 5.0 * std::cos(0.4))),
            kSmallMotion);
  move(at(260.0, 90.0, true));
  EXPECT_GT(target().y, kSmallMotion);
  move(at(260.0, 90.0, false));
  EXPECT_FALSE(control_.is_turning());
}

TEST_F(CameraControlTest, DoesNotTurnByAJumpOfTheCursor) {
  move(at(100.0, 100.0, false));
  move(at(100.0, 100.0, true));
  control_.set_cursor(dvec2(700.0, -300.0));
  move(at(700.0, -300.0, true));
  EXPECT_FALSE(has_turned());
}

TEST_F(CameraControlTest, IgnoresAButtonThatWentDownOverThePanel) {
  ControlState over_panel = at(10.0, 10.0, false);
  over_panel.panel_has_mouse = true;
  move(over_panel);
  over_panel.button_is_down = true;
  move(over_panel);
  // Dragged out of the panel.
  move(at(300.0, 10.0, true));
  move(at(400.0, 10.0, true));
  EXPECT_FALSE(control_.is_turning());
  EXPECT_FALSE(has_turned());
}

TEST_F(CameraControlTest, GoesOnTurningOverThePanel) {
  move(at(300.0, 10.0, false));
  move(at(300.0, 10.0, true));
  ControlState over_panel = at(10.0, 10.0, true);
  over_panel.panel_has_mouse = true;
  move(over_panel);
  EXPECT_TRUE(control_.is_turning());
  EXPECT_TRUE(has_turned());
}

TEST_F(CameraControlTest, AfterStoppingNeedsTheButtonAgain) {
  move(at(100.0, 100.0, false));
  move(at(100.0, 100.0, true));
  control_.stop_turning();
  EXPECT_FALSE(control_.is_turning());
  move(at(200.0, 100.0, true));
  move(at(300.0, 100.0, true));
  EXPECT_FALSE(has_turned());
  move(at(300.0, 100.0, false));
  move(at(300.0, 100.0, true));
  move(at(310.0, 100.0, true));
  EXPECT_TRUE(has_turned());
}

TEST_F(CameraControlTest, OrbitsAroundTheTarget) {
  ControlState state;
  state.orbits = true;
  control_.turn_wheel(1.0);
  move(state);
  EXPECT_LT(glm::distance(eye(), dvec3(0.0, 0.0, 4.5)), kSmallMotion);
  state.cursor = dvec2(0.0);
  state.button_is_down = true;
  move(state);
  state.cursor = dvec2(50.0, 0.0);
  move(state);
  EXPECT_FALSE(has_turned());
  EXPECT_NEAR(glm::length(eye()), 4.5, kSmallMotion);
  EXPECT_GT(std::abs(eye().x), kSmallMotion);
}

}  // namespace
}  // namespace trisect::view
