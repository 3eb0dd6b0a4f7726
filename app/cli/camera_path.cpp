#include "app/cli/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "app/base/error.h"

namespace trisect {
namespace {

using glm::dvec3;
using Json = nlohmann::json;

// A rotation about an axis, by radians.
glm::dmat3 turn_around(const dvec3& axis, double angle) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(axis)));
}

// What a path's file says, or InputError with its name.
class PathReader {
 public:
  explicit PathReader(const std::string& file) : file_(file) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}.", file_, what));
  }

  void expect_names(const Json& object, const std::string& what,
                    std::initializer_list<const char*> names) const {
    if (!object.is_object()) fail(what + " is no object");
    for (const auto& [name, value] : object.items()) {
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      fail(fmt::format("{} has '{}', which is not one of: {}", what, name, fmt::join(names, ", ")));
    }
  }

  [[nodiscard]] double number(const Json& value, const std::string& what, double low,
                              double high) const {
    if (value.is_number() && value.get<double>() >= low && value.get<double>() <= high) {
      return value.get<double>();
    }
    fail(fmt::format("{} is not a number from {:g} to {:g}", what, low, high));
  }

  [[nodiscard]] std::optional<dvec3> triple(const Json& key, const char* name,
                                            const std::string& what) const {
    if (!key.contains(name)) return std::nullopt;
    const Json& value = key.at(name);
    const std::string whose = fmt::format("{} of {}", name, what);
    if (!value.is_array() || value.size() != 3) fail(whose + " is not three numbers");
    constexpr double largest = 1e12;  // as --eye allows
    dvec3 triple(0.0);
    for (int i = 0; i < 3; ++i) {
      triple[i] = number(value.at(static_cast<std::size_t>(i)), whose, -largest, largest);
    }
    return triple;
  }

 private:
  const std::string& file_;
};

// A key's value and frame.
template <typename Value>
struct Knot {
  double frame;
  Value value;
};

template <typename Value>
Value interpolated(const std::vector<Knot<Value>>& knots, double frame) {
  if (frame <= knots.front().frame) return knots.front().value;
  if (frame >= knots.back().frame) return knots.back().value;
  std::size_t i = 0;
  while (knots[i + 1].frame <= frame) ++i;
  const auto slope = [&](std::size_t k) {
    const std::size_t before = k == 0 ? 0 : k - 1;
    const std::size_t after = std::min(k + 1, knots.size() - 1);
    return (knots[after].value - knots[before].value) / (knots[after].frame - knots[before].frame);
  };
  const double length = knots[i + 1].frame - knots[i].frame;
  const double t = (frame - knots[i].frame) / length;
  const double s = 1.0 - t;
  return knots[i].value * (s * s * (1.0 + 2.0 * t)) + slope(i) * (length * s * s * t) +
         knots[i + 1].value * (t * t * (3.0 - 2.0 * t)) - slope(i + 1) * (length * t * t * s);
}

}  // namespace

CameraPath CameraPath::turntable(uint32_t frames) {
  CameraPath path;
  path.frames_ = frames;
  return path;
}

Camera CameraPath::framing(const Camera& camera, std::span<const dvec3> vertices, double aspect) {
  // Between two of so many directions a vertex that leaves the picture in the middle does so by two
  // hundredths of its distance from the axis (1 - cos(11.25 degrees)), which is within the margin.
  constexpr uint32_t directions = 16;
  const CameraPath around = turntable(directions);
  Camera farthest = camera;
  std::vector<dvec3> turned(vertices.size());
  for (uint32_t k = 1; k < directions; ++k) {
    const glm::dmat3 turn = turn_around(camera.up, -around.angle(k));
    std::transform(vertices.begin(), vertices.end(), turned.begin(), [&](const dvec3& vertex) {
      return camera.target + turn * (vertex - camera.target);
    });
    const Camera framed = framing_camera(turned, camera.target, camera.fov, camera.up, aspect);
    if (glm::distance(framed.eye, camera.target) > glm::distance(farthest.eye, camera.target)) {
      farthest = framed;
    }
  }
  return farthest;
}

CameraPath CameraPath::from_json(std::string_view text, const std::string& file) {
  const PathReader reader(file);
  const Json root = Json::parse(text, nullptr, false);
  if (root.is_discarded()) reader.fail("is not JSON");
  reader.expect_names(root, "the path", {"frames", "keys"});
  if (!root.contains("keys") || !root["keys"].is_array() || root["keys"].empty()) {
    reader.fail("has no keys");
  }
  CameraPath path;
  for (const Json& key : root["keys"]) {
    const std::string what = fmt::format("key {}", path.keys_.size());
    reader.expect_names(key, what, {"frame", "eye", "target", "up", "fov"});
    if (!key.contains("frame")) reader.fail(what + " has no frame");
    Key read{
        reader.number(key.at("frame"), "frame of " + what, 0.0, kMostFrames - 1), {}, {}, {}, {}};
    if (!path.keys_.empty() && read.frame <= path.keys_.back().frame) {
      reader.fail(fmt::format("frame of {} is not after that of the key before", what));
    }
    read.eye = reader.triple(key, "eye", what);
    read.target = reader.triple(key, "target", what);
    read.up = reader.triple(key, "up", what);
    if (key.contains("fov")) {
      read.fov = reader.number(key.at("fov"), fmt::format("fov of {}", what), 1.0, 170.0);
    }
    path.keys_.push_back(read);
  }
  const double frames = root.contains("frames")
                            ? reader.number(root.at("frames"), "frames", 1.0, kMostFrames)
                            : std::floor(path.keys_.back().frame) + 1.0;
  if (frames != std::floor(frames)) reader.fail("frames is not a whole number");
  path.frames_ = static_cast<uint32_t>(frames);
  return path;
}

Camera CameraPath::at(uint32_t frame, const Camera& start) const {
  Camera camera = start;
  if (keys_.empty()) {
    if (frame == 0) return camera;
    camera.eye = start.target + turn_around(start.up, angle(frame)) * (start.eye - start.target);
    return camera;
  }
  // member: of a key; before: its value before the first key that has one.
  const auto value_at = [&](auto member, auto before) {
    std::vector<Knot<decltype(before)>> knots;
    knots.reserve(keys_.size());
    for (const Key& key : keys_) {
      before = (key.*member).value_or(before);
      knots.push_back({key.frame, before});
    }
    return interpolated(knots, frame);
  };
  camera.eye = value_at(&Key::eye, start.eye);
  camera.target = value_at(&Key::target, start.target);
  camera.up = value_at(&Key::up, start.up);
  // The spline may leave the range of its keys.
  camera.fov = std::clamp(value_at(&Key::fov, start.fov), 1.0, 170.0);
  return camera;
}

}  // namespace trisect
