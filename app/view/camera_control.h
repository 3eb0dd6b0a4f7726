// Moves the camera by what the user holds, turns and drags.
#pragma once

#include <glm/glm.hpp>

#include "app/view/clock.h"
#include "app/view/navigator.h"

namespace trisect::view {

// Keys that walk: whether each is held.
struct WalkKeys {
  bool left = false;
  bool right = false;
  bool up = false;
  bool down = false;
  bool ahead = false;
  bool back = false;
};

// Motion::steps of these keys: opposite ones cancel.
glm::dvec3 steps_of(const WalkKeys& keys);

// What keys and mouse are doing now.
struct ControlState {
  WalkKeys keys;
  bool button_is_down = false;   // the left button of the mouse
  bool panel_has_mouse = false;  // the panel takes what the mouse does
  glm::dvec2 cursor{0.0};        // pixels, to the right and down
  bool orbits = false;           // the camera goes around its target instead of walking
};

// Pressing the left button outside of the panel takes the cursor: until the button is released, or
// Esc is pressed, the mouse turns the camera. Not thread safe.
class CameraControl {
 public:
  explicit CameraControl(Clock::time_point now) : last_move_(now) {}

  // The camera goes on from this one, with a speed for a scene of this radius.
  void set(const Camera& camera, double scene_radius);

  // Steps of the wheel, away from the user positive, for the next move().
  void turn_wheel(double steps) { wheel_ += steps; }

  // Moves the camera by what was held since the last call, at most a tenth of a second of it: after
  // a pause of the loop the camera does not jump.
  void move(const ControlState& state, Clock::time_point now);

  [[nodiscard]] bool is_turning() const { return mouse_ == Mouse::turning; }

  // The button has to be pressed again before the mouse turns the camera.
  void stop_turning();

  // The cursor is here now, but not by a motion of the mouse.
  void set_cursor(const glm::dvec2& cursor) { cursor_ = cursor; }

  [[nodiscard]] const Camera& camera() const { return navigator_.camera(); }

 private:
  enum class Mouse {
    ignored,  // what the button does is not for the camera until it is released
    ready,    // pressing the button begins to turn the camera
    turning,
  };

  // How far the mouse turns the camera, radians to the right and up.
  glm::dvec2 turn_by(const ControlState& state);

  Navigator navigator_{Camera{}, 1.0};
  Mouse mouse_ = Mouse::ignored;
  glm::dvec2 cursor_{0.0};  // at the last move
  double wheel_ = 0.0;      // steps since the last move
  Clock::time_point last_move_;
};

}  // namespace trisect::view
