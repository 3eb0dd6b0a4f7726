#include "app/cli/camera_path.h"

#include <gtest/gtest.h>

#include <string>

#include "app/base/error.h"

namespace trisect {
namespace {

const Camera kStart{{3.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, 45.0};

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_LT(glm::distance(a, b), 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST(CameraPath, TurnsOnceAroundTheTarget) {
  const CameraPath path = CameraPath::turntable(4);
  EXPECT_EQ(path.frames(), 4U);
  // The first frame is the camera itself, to the last bit.
  EXPECT_EQ(path.at(0, kStart).eye, kStart.eye);
  expect_near(path.at(1, kStart).eye, {1.0, 1.0, -2.0});
  expect_near(path.at(2, kStart).eye, {-1.0, 1.0, 0.0});
  expect_near(path.at(3, kStart).eye, {1.0, 1.0, 2.0});
  EXPECT_EQ(path.at(3, kStart).target, kStart.target);
  EXPECT_EQ(path.at(3, kStart).fov, kStart.fov);
}

TEST(CameraPath, GoesThroughItsKeys) {
  const CameraPath path = CameraPath::from_json(
      R"({"keys": [{"frame": 10, "eye": [1, 0, 5]}, {"frame": 20, "fov": 30},
                   {"frame": 40, "eye": [4, 2, 5], "target": [0, 1, 0], "up": [1, 0, 0]}]})",
      "path.json");
  EXPECT_EQ(path.frames(), 41U);
  expect_near(path.at(0, kStart).eye, {1.0, 0.0, 5.0});
  expect_near(path.at(10, kStart).eye, {1.0, 0.0, 5.0});
  expect_near(path.at(20, kStart).eye, {1.0, 0.0, 5.0});
  expect_near(path.at(40, kStart).eye, {4.0, 2.0, 5.0});
  EXPECT_EQ(path.at(10, kStart).target, kStart.target);
  EXPECT_EQ(path.at(10, kStart).fov, 45.0);
  EXPECT_EQ(path.at(20, kStart).fov, 30.0);
  EXPECT_EQ(path.at(40, kStart).fov, 30.0);
  expect_near(path.at(40, kStart).up, {1.0, 0.0, 0.0});
}

// A spline through keys on a line with even speed is that line; its slope does not jump at a key.
TEST(CameraPath, IsSmooth) {
  const CameraPath line = CameraPath::from_json(
      R"({"keys": [{"frame": 0, "eye": [0, 0, 1]}, {"frame": 10, "eye": [1, 0, 1]},
                   {"frame": 40, "eye": [4, 0, 1]}]})",
      "path.json");
  for (uint32_t frame = 0; frame <= 40; ++frame) {
    expect_near(line.at(frame, kStart).eye, {frame / 10.0, 0.0, 1.0});
  }
  const CameraPath curve = CameraPath::from_json(
      R"({"keys": [{"frame": 0, "eye": [0, 0, 1]}, {"frame": 1000, "eye": [1, 0, 1]},
                   {"frame": 3000, "eye": [0, 0, 1]}, {"frame": 3500, "eye": [0, 4, 1]}]})",
      "path.json");
  const auto eye = [&](uint32_t frame) { return curve.at(frame, kStart).eye; };
  for (const uint32_t key : {1000U, 3000U}) {
    const glm::dvec3 before = eye(key) - eye(key - 1);
    const glm::dvec3 after = eye(key + 1) - eye(key);
    // Between two frames the slope changes by no more than the second derivative.
    EXPECT_LT(glm::distance(before, after), 1e-4);
  }
}

TEST(CameraPath, StaysWithinTheFieldsOfViewThatThereAre) {
  const CameraPath path = CameraPath::from_json(
      R"({"keys": [{"frame": 0, "fov": 20}, {"frame": 10, "fov": 170}, {"frame": 11, "fov": 170},
                   {"frame": 30, "fov": 1}, {"frame": 31, "fov": 1}]})",
      "path.json");
  for (uint32_t frame = 0; frame < path.frames(); ++frame) {
    EXPECT_GE(path.at(frame, kStart).fov, 1.0);
    EXPECT_LE(path.at(frame, kStart).fov, 170.0);
  }
}

TEST(CameraPath, RefusesWhatIsNoPath) {
  const auto expect_refused = [](const std::string& text, const std::string& why) {
    try {
      CameraPath::from_json(text, "path.json");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("path.json: "), 0U) << error.what();
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  expect_refused("", "is not JSON");
  expect_refused("{", "is not JSON");
  expect_refused("[]", "the path is no object");
  expect_refused("{}", "has no keys");
  expect_refused(R"({"keys": []})", "has no keys");
  expect_refused(R"({"keys": [1]})", "key 0 is no object");
  expect_refused(R"({"keys": [{}]})", "key 0 has no frame");
  expect_refused(R"({"keys": [{"frame": -1}]})", "frame of key 0 is not a number from 0");
  expect_refused(R"({"keys": [{"frame": "1"}]})", "frame of key 0 is not a number");
  expect_refused(R"({"keys": [{"frame": 5}, {"frame": 5}]})", "not after that of the key before");
  expect_refused(R"({"keys": [{"frame": 0, "eye": [1, 2]}]})", "eye of key 0 is not three numbers");
  expect_refused(R"({"keys": [{"frame": 0, "eye": [1, 2, 1e13]}]})",
                 "eye of key 0 is not a number");
  expect_refused(R"({"keys": [{"frame": 0, "up": [1, 2, null]}]})", "up of key 0 is not a number");
  expect_refused(R"({"keys": [{"frame": 0, "fov": 171}]})",
                 "fov of key 0 is not a number from 1 to 170");
  expect_refused(R"({"keys": [{"frame": 0, "zoom": 1}]})", "key 0 has 'zoom', which is not one of");
  expect_refused(R"({"keys": [{"frame": 0}], "frames": 1.5})", "frames is not a whole number");
  expect_refused(R"({"keys": [{"frame": 0}], "frames": 0})", "frames is not a number from 1");
  expect_refused(R"({"keys": [{"frame": 0}], "frames": 1e9})", "frames is not a number from 1");
}

}  // namespace
}  // namespace trisect
