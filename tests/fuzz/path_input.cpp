#include <cmath>

#include "app/cli/camera_path.h"
#include "tests/fuzz/answers.h"

namespace trisect::fuzz {
namespace {

bool is_finite(const Camera& camera) {
  return std::isfinite(camera.fov) && std::isfinite(glm::dot(camera.eye, camera.eye)) &&
         std::isfinite(glm::dot(camera.target, camera.target)) &&
         std::isfinite(glm::dot(camera.up, camera.up));
}

}  // namespace

void path_input(Bytes input) {
  expect_answer([&] {
    const CameraPath path = CameraPath::from_json(text_of(input), "path.json");
    expect(path.frames() >= 1 && path.frames() <= kMostFrames, "a path of no or too many frames");
    const Camera start{{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45.0};
    for (const uint32_t frame : {0U, 1U, path.frames() / 3, path.frames() / 2, path.frames() - 1}) {
      expect(is_finite(path.at(frame, start)), "a camera that is not finite");
    }
  });
}

}  // namespace trisect::fuzz
