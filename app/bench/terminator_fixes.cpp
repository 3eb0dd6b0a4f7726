#include "app/bench/terminator_fixes.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace trisect::bench {

using glm::vec3;

vec3 SmoothPoint::position() const {
  return vertices[0] * weights[0] + vertices[1] * weights[1] + vertices[2] * weights[2];
}

vec3 SmoothPoint::normal() const {
  return glm::normalize(normals[0] * weights[0] + normals[1] * weights[1] +
                        normals[2] * weights[2]);
}

vec3 on_tangent_planes(const SmoothPoint& point) {
  const vec3 at = point.position();
  vec3 raised = at;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const float below = std::min(0.0F, glm::dot(at - point.vertices[k], point.normals[k]));
    raised -= point.weights[i] * below * point.normals[k];
  }
  return raised;
}

vec3 under_envelope(const SmoothPoint& point, const vec3& face, const vec3& light) {
  constexpr float cutoff = 0.1F;
  const vec3 at = point.position();
  const float of_normal = glm::dot(point.normal(), light);
  const float of_face = glm::dot(face, light) / cutoff;
  const float share = std::clamp(
      of_normal < cutoff ? 2.0F - of_face - of_normal / cutoff : 1.0F - of_face, 0.0F, 1.0F);
  if (share == 0.0F) return at;
  vec3 along(0.0F);
  float paraboloid = 0.0F;
  float envelope = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto weight = [&](std::size_t k) { return point.weights[static_cast<int>(k % 3)]; };
    const auto normal = [&](std::size_t k) { return point.normals[k % 3]; };
    // An edge to each of the others.
    const vec3 one = point.vertices[(i + 1) % 3] - point.vertices[i];
    const vec3 other = point.vertices[(i + 2) % 3] - point.vertices[i];
    along += weight(i) * normal(i);
    paraboloid += weight(i) * weight(i + 1) * glm::dot(normal(i + 1) - normal(i), one);
    const float highest = std::max({0.0F, glm::dot(one, normal(i)), glm::dot(other, normal(i))});
    const float height = glm::dot(point.vertices[i] - at, normal(i)) + highest;
    envelope = std::min(envelope, std::max(height, 0.0F));
  }
  return at + share * std::max(envelope, 0.5F * paraboloid) * along;
}

float softening(const vec3& face, const vec3& normal, const vec3& light) {
  const float facing = glm::dot(face, light);
  if (!(facing > 0.0F)) return 0.0F;
  const float both = glm::dot(normal, light) * glm::dot(normal, face);
  const float g = both > 0.0F ? std::min(1.0F, facing / both) : 1.0F;
  return g * (1.0F + g * (1.0F - g));
}

}  // namespace trisect::bench
