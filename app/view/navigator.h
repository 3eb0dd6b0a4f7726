// A camera that walks, and one that goes around a point.
#pragma once

#include <glm/glm.hpp>

#include "app/dispatch/camera.h"

namespace trisect::view {

// What keys and mouse ask for.
struct Motion {
  glm::dvec3 steps{0.0};  // right, up (along the camera's up vector), ahead: -1, 0 or 1
  glm::dvec2 turn{0.0};   // to the right and up, radians
  double wheel = 0.0;     // steps
};

class Navigator {
 public:
  // size: of the scene, which sets the speed.
  Navigator(const Camera& camera, double size) : camera_(camera), speed_(size) {}

  // Another camera, from which it goes on.
  void set(const Camera& camera) { camera_ = camera; }

  [[nodiscard]] const Camera& camera() const { return camera_; }
  void set_speed(double speed) { speed_ = speed; }
  [[nodiscard]] double speed() const { return speed_; }  // in units of the scene a second
  void set_orbits(bool orbits) { orbits_ = orbits; }

  // Walking, the eye turns in its place and the wheel sets the speed; in orbit it goes around the
  // target, and the wheel brings it nearer. Returns whether the camera is another one.
  bool move(const Motion& motion, double seconds);

 private:
  void turn(const glm::dvec2& by);

  Camera camera_;
  double speed_;
  bool orbits_ = false;
};

}  // namespace trisect::view
