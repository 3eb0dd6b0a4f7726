#include "app/view/navigator.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace trisect::view {

using glm::dvec3;

namespace {

// What a step of the wheel multiplies the speed, or the distance in orbit, by.
constexpr double kFaster = 1.25;
constexpr double kNearer = 0.9;

// Least angle between the line of sight and the up vector or its opposite, in radians: a camera
// that looks along either has no defined horizon.
constexpr double kPole = 0.01;

dvec3 turned(const dvec3& v, double angle, const dvec3& axis) {
  return dvec3(glm::rotate(glm::dmat4(1.0), angle, axis) * glm::dvec4(v, 0.0));
}

}  // namespace

void Navigator::turn(const glm::dvec2& by) {
  const dvec3 up = glm::normalize(camera_.up);
  dvec3 ahead = camera_.target - camera_.eye;
  const double from_up = std::acos(std::clamp(glm::dot(glm::normalize(ahead), up), -1.0, 1.0));
  // In orbit the mouse drags the model: the eye moves the opposite way.
  const double sense = orbits_ ? -1.0 : 1.0;
  const double rise =
      std::clamp(sense * by.y, from_up - (std::acos(-1.0) - kPole), from_up - kPole);
  ahead = turned(ahead, -sense * by.x, up);
  ahead = turned(ahead, rise, glm::normalize(glm::cross(ahead, up)));
  if (orbits_) {
    camera_.eye = camera_.target - ahead;
  } else {
    camera_.target = camera_.eye + ahead;
  }
}

bool Navigator::move(const Motion& motion, double seconds) {
  const Camera before = camera_;
  if (motion.turn != glm::dvec2(0.0)) turn(motion.turn);
  if (motion.wheel != 0.0) {
    if (orbits_) {
      camera_.eye =
          camera_.target + (camera_.eye - camera_.target) * std::pow(kNearer, motion.wheel);
    } else {
      speed_ *= std::pow(kFaster, motion.wheel);
    }
  }
  if (motion.steps != dvec3(0.0)) {
    const dvec3 up = glm::normalize(camera_.up);
    const dvec3 ahead = glm::normalize(camera_.target - camera_.eye);
    const dvec3 right = glm::normalize(glm::cross(ahead, up));
    const dvec3 by = (right * motion.steps.x + up * motion.steps.y + ahead * motion.steps.z) *
                     (speed_ * seconds);
    camera_.eye += by;
    camera_.target += by;
  }
  return camera_.eye != before.eye || camera_.target != before.target;
}

}  // namespace trisect::view
