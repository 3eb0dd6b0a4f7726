// The motion of a camera that walks, or that orbits around a point.
#pragma once

#include <glm/glm.hpp>

#include "app/dispatch/camera.h"

namespace trisect::view {

// What keys and mouse ask for in one step of time.
struct Motion {
  glm::dvec3 steps{0.0};  // walk right, up (along the camera's up vector), ahead: -1, 0 or 1
  glm::dvec2 turn{0.0};   // look to the right and up, radians
  double wheel = 0.0;     // steps, away from the user positive
};

class Navigator {
 public:
  // speed: in units of the scene per second.
  Navigator(const Camera& camera, double speed) : camera_(camera), speed_(speed) {}

  // Goes on from this camera.
  void set(const Camera& camera) { camera_ = camera; }

  [[nodiscard]] const Camera& camera() const { return camera_; }
  void set_speed(double speed) { speed_ = speed; }
  [[nodiscard]] double speed() const { return speed_; }
  void set_orbits(bool orbits) { orbits_ = orbits; }

  // While the camera walks, turning turns the view about the eye, and the wheel changes the speed.
  // While it orbits, turning moves the eye around the target, and the wheel changes their distance.
  // Returns whether the camera has changed.
  bool move(const Motion& motion, double seconds);

 private:
  void turn(const glm::dvec2& by);

  Camera camera_;
  double speed_;
  bool orbits_ = false;
};

}  // namespace trisect::view
