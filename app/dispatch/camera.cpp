#include "app/dispatch/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "app/base/error.h"

namespace trisect {

using glm::dvec3;
using glm::dvec4;

Camera framing_camera(std::span<const dvec3> vertices, const dvec3& center, double fov,
                      const dvec3& up, double aspect) {
  // The view direction, in a frame whose y axis is `up`: mostly along z, a little along x and y.
  const dvec3 y = glm::normalize(up);
  const dvec3 helper = std::abs(y.z) < 0.9 ? dvec3(0.0, 0.0, 1.0) : dvec3(0.0, -1.0, 0.0);
  const dvec3 z = glm::normalize(helper - y * glm::dot(helper, y));
  const dvec3 backward = glm::normalize(glm::cross(y, z) * 0.35 + y * 0.45 + z);
  const dvec3 right = glm::normalize(glm::cross(y, backward));
  const dvec3 upward = glm::cross(backward, right);

  // The vertices fill at most this fraction of the image's width and height; the curved surfaces
  // bulge beyond them.
  constexpr double fill = 0.84;
  const double half_height = fill * std::tan(glm::radians(fov) * 0.5);
  double distance = 0.0;
  for (const dvec3& vertex : vertices) {
    const dvec3 p = vertex - center;
    const double extent =
        std::max(std::abs(glm::dot(p, upward)), std::abs(glm::dot(p, right)) / aspect);
    distance = std::max(distance, glm::dot(p, backward) + extent / half_height);
  }
  return {center + backward * distance, center, up, fov};
}

dvec3 view_direction(const Camera& camera, uint32_t width, uint32_t height, double x, double y) {
  const dvec3 forward = glm::normalize(camera.target - camera.eye);
  const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const dvec3 upward = glm::cross(right, forward);
  // At distance 1 ahead of the eye the image is 2 tan(fov / 2) high.
  const double pixel = 2.0 * std::tan(glm::radians(camera.fov) * 0.5) / height;
  return glm::normalize(forward + right * (pixel * (x - 0.5 * width)) +
                        upward * (pixel * (0.5 * height - y)));
}

void set_rays(const Camera& camera, const dvec3& origin, double radius, double near, double far,
              TraceParams& params) {
  const dvec3 forward = camera.target - camera.eye;
  const double sine =
      glm::length(glm::cross(forward, camera.up)) / (glm::length(forward) * glm::length(camera.up));
  if (!(sine > 1e-9)) {
    throw UsageError(
        "--eye, --target and --up do not make a camera: it must look somewhere, and not "
        "along --up.");
  }
  const double aspect =
      static_cast<double>(params.image_width) / static_cast<double>(params.image_height);
  const dvec3 eye = camera.eye - origin;
  // The view matrix has its origin at the eye, so a camera far from the scene's origin loses no
  // precision.
  const glm::dmat4 view = glm::lookAt(dvec3(0.0), forward, camera.up);
  const glm::dmat4 projection = glm::perspective(glm::radians(camera.fov), aspect, near, far);
  const glm::dmat4 unproject = glm::inverse(projection * view);
  const auto near_point = [&](double x, double y) {
    const dvec4 p = unproject * dvec4(x, y, -1.0, 1.0);
    return dvec3(p) / p.w;
  };
  const dvec3 corner = near_point(-1.0, 1.0);
  const dvec3 dx = (near_point(1.0, 1.0) - corner) / static_cast<double>(params.image_width);
  const dvec3 dy = (near_point(-1.0, -1.0) - corner) / static_cast<double>(params.image_height);
  params.eye = vec4(glm::vec3(eye), static_cast<float>(far / near));
  params.ray_corner = vec4(glm::vec3(corner), 0.0F);
  params.ray_dx = vec4(glm::vec3(dx), 0.0F);
  params.ray_dy = vec4(glm::vec3(dy), 0.0F);
  // The anchor lies in a plane parallel to the near plane: that through the scene's origin. Close
  // to the model, rays at the image's corners would meet that plane far beyond their hits, so a
  // nearer plane is taken.
  double depth = std::max(glm::dot(-eye, glm::normalize(forward)), near);
  if (glm::length(eye) < 2.0 * radius) {
    const double corner_slope = glm::length(corner - near_point(0.0, 0.0)) / near;
    depth = std::clamp(2.0 * radius / corner_slope, near, depth);
  }
  const double scale = depth / near;
  const auto axis = [](const dvec3& a, double w) {
    return vec4(glm::vec3(glm::normalize(a)), static_cast<float>(w));
  };
  params.anchor = vec4(glm::vec3(eye + near_point(0.0, 0.0) * scale), static_cast<float>(depth));
  params.frame_x = axis(dx, glm::length(dx) * scale);
  params.frame_y = axis(dy, glm::length(dy) * scale);
  params.frame_z = axis(forward, near - depth);
}

}  // namespace trisect
