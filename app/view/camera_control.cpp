#include "app/view/camera_control.h"

#include <algorithm>
#include <utility>

namespace trisect::view {
namespace {

// Radians for each pixel that the mouse moves.
constexpr double kTurnPerPixel = 0.004;

// Seconds of motion in one move at most.
constexpr double kLongestMove = 0.1;

double axis(bool positive, bool negative) {
  return (positive ? 1.0 : 0.0) - (negative ? 1.0 : 0.0);
}

}  // namespace

glm::dvec3 steps_of(const WalkKeys& keys) {
  return {axis(keys.right, keys.left), axis(keys.up, keys.down), axis(keys.ahead, keys.back)};
}

void CameraControl::set(const Camera& camera, double scene_radius) {
  navigator_.set(camera);
  navigator_.set_speed(scene_radius);
}

void CameraControl::stop_turning() {
  if (is_turning()) mouse_ = Mouse::ignored;
}

glm::dvec2 CameraControl::turn_by(const ControlState& state) {
  if (!state.button_is_down) {
    mouse_ = state.panel_has_mouse ? Mouse::ignored : Mouse::ready;
  } else if (mouse_ == Mouse::turning) {
    return glm::dvec2(state.cursor.x - cursor_.x, cursor_.y - state.cursor.y) * kTurnPerPixel;
  } else if (mouse_ == Mouse::ready && !state.panel_has_mouse) {
    mouse_ = Mouse::turning;
  }
  return glm::dvec2(0.0);
}

void CameraControl::move(const ControlState& state, Clock::time_point now) {
  const double seconds =
      std::min(seconds_between(std::exchange(last_move_, now), now), kLongestMove);
  Motion motion;
  motion.steps = steps_of(state.keys);
  motion.turn = turn_by(state);
  motion.wheel = std::exchange(wheel_, 0.0);
  cursor_ = state.cursor;
  navigator_.set_orbits(state.orbits);
  navigator_.move(motion, seconds);
}

}  // namespace trisect::view
