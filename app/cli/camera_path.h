// Where the camera of a sequence of frames is.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/dispatch/camera.h"

namespace trisect {

// The most frames of a sequence.
constexpr uint32_t kMostFrames = 1000000;

class CameraPath {
 public:
  // So many frames, in which the eye goes once around the target, around the up vector, counted
  // from the camera that at() gets.
  static CameraPath turntable(uint32_t frames);

  // A camera that frames vertices, farther away where it must be for all of them to be seen from
  // everywhere on the way around its target. aspect: of the image, width over height.
  static Camera framing(const Camera& camera, std::span<const glm::dvec3> vertices, double aspect);

  // Keyframes as JSON: {"frames": 90, "keys": [{"frame": 0, "eye": [3, 1, 4], "target": [0, 0, 0],
  // "up": [0, 1, 0], "fov": 45}, ...]}. What a key leaves out is that of the key before, in the
  // first one that of the camera that at() gets; without "frames" the last key is the last frame.
  // Throws InputError, naming the file, for anything else.
  static CameraPath from_json(std::string_view text, const std::string& file);

  [[nodiscard]] uint32_t frames() const { return frames_; }

  // The camera of a frame; start: without the path. Between keys each component follows a cubic
  // Hermite spline, whose slope at a key is that between the keys around it (Catmull and Rom 1974,
  // with the frames as parameter), so that the camera neither jumps nor turns a corner; before the
  // first key and after the last one it stands still.
  [[nodiscard]] Camera at(uint32_t frame, const Camera& start) const;

 private:
  // What a key says of the camera.
  struct Key {
    double frame;
    std::optional<glm::dvec3> eye;
    std::optional<glm::dvec3> target;
    std::optional<glm::dvec3> up;
    std::optional<double> fov;
  };

  // Of a turntable's frame, in radians.
  [[nodiscard]] double angle(uint32_t frame) const { return glm::radians(360.0) * frame / frames_; }

  uint32_t frames_ = 0;
  std::vector<Key> keys_;  // none: a turntable
};

}  // namespace trisect
