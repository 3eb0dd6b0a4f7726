#include "app/judge/hard_rays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <string>

#include "app/stress/stress_scenes.h"
#include "app/surface/patch_range.h"

namespace trisect {
namespace {

using glm::dvec3;
using stress::SurfacePoint;
using Random = std::mt19937_64;

// How far before their points rays begin, in radii: outside of the model.
constexpr double kBefore = 4.0;

dvec3 rounded(const dvec3& v) {
  return dvec3(glm::vec3(v));
}

// Begins so far before the point. What the rounding of the origin moves the direction makes good.
FileRay ray_at(const dvec3& point, const dvec3& direction, double before) {
  FileRay ray;
  ray.origin = rounded(point - glm::normalize(direction) * before);
  ray.direction = rounded(glm::normalize(point - ray.origin));
  return ray;
}

// Weights of a point of one of the triangle's edges, `along` it from one vertex to the next.
dvec3 weights_on_edge(uint64_t edge, double along) {
  dvec3 weights(0.0);
  const int first = static_cast<int>(edge % 3);
  weights[first] = 1.0 - along;
  weights[(first + 1) % 3] = along;
  return weights;
}

// A point of a triangle of which there is a surface, at the weights that `weights_of` gives.
template <typename WeightsOf>
SurfacePoint point_by(const BakedScene& scene, Random& random, WeightsOf&& weights_of) {
  while (true) {
    const auto triangle = static_cast<uint32_t>(random() % scene.triangles.size());
    if (has_surface(scene.triangles[triangle])) {
      return stress::point_at(scene, triangle, weights_of());
    }
  }
}

class Maker {
 public:
  Maker(const BakedScene& scene, uint32_t seed) : scene_(scene), random_(seed) {}

  FileRay random_ray() { return ray_at(inner_point().position, direction(), before()); }

  FileRay at_vertex() {
    const SurfacePoint point =
        point_by(scene_, random_, [&] { return weights_on_edge(random_(), 0.0); });
    return ray_at(point.position, direction(), before());
  }

  FileRay at_edge() { return ray_at(edge_point().position, direction(), before()); }

  FileRay along_edge() {
    const SurfacePoint point = edge_point();
    const Triangle& tri = scene_.triangles[point.triangle];
    // The edge is that of the vertex without weight.
    int opposite = 0;
    for (int k = 1; k < 3; ++k) {
      if (point.weights[k] < point.weights[opposite]) opposite = k;
    }
    const dvec3 edge =
        dvec3(tri.Position[(opposite + 2) % 3]) - dvec3(tri.Position[(opposite + 1) % 3]);
    const dvec3 along = glm::normalize(edge) * (random_() % 2 == 0 ? 1.0 : -1.0);
    return ray_at(point.position, along - 1e-3 * dvec3(tri.TriNormal), before());
  }

  FileRay grazing() {
    constexpr std::array<double, 7> offsets{0.0, 1e-6, -1e-6, 1e-4, -1e-4, 1e-2, -1e-2};
    const SurfacePoint point = inner_point();
    const double off = offsets[random_() % offsets.size()] * scene_.extent;
    dvec3 along = stress::across(point.normal, random_);
    // A tangent of a flat triangle lies in it and has no first point with it.
    if (scene_.choice.surface == SURFACE_FLAT) along -= 1e-3 * point.normal;
    return ray_at(point.position + point.normal * off, along, before());
  }

  FileRay far() { return ray_at(inner_point().position, direction(), 1e4 * scene_.extent); }

  FileRay by_axes() {
    dvec3 d(0.0);
    const auto axis = static_cast<int>(random_() % 3);
    if (random_() % 2 == 0) {
      d[axis] = random_() % 2 == 0 ? 1.0 : -1.0;
    } else {
      d = direction();
      d[axis] = 0.0;
    }
    FileRay ray = ray_at(inner_point().position, d, before());
    ray.direction = rounded(glm::normalize(d));
    return ray;
  }

  FileRay leaving() {
    FileRay ray;
    ray.origin = rounded(inner_point().position);
    ray.direction = rounded(direction());
    ray.t_min = 1e-3 * scene_.extent;
    return ray;
  }

 private:
  dvec3 direction() { return stress::any_direction(random_); }
  [[nodiscard]] double before() const { return kBefore * scene_.extent; }

  // With a normal.
  SurfacePoint inner_point() {
    while (true) {
      const SurfacePoint point = stress::any_point(scene_, random_);
      const bool is_one = has_surface(scene_.triangles[point.triangle]) &&
                          std::isfinite(glm::dot(point.normal, point.position));
      if (is_one) return point;
    }
  }

  SurfacePoint edge_point() {
    std::uniform_real_distribution<double> along(0.02, 0.98);
    return point_by(scene_, random_, [&] { return weights_on_edge(random_(), along(random_)); });
  }

  const BakedScene& scene_;
  Random random_;
};

}  // namespace

std::vector<FileRay> hard_rays(const BakedScene& scene, std::string_view kind, std::size_t count,
                               uint32_t seed) {
  static const std::map<std::string_view, FileRay (Maker::*)()> makers{
      {"random", &Maker::random_ray}, {"vertex", &Maker::at_vertex}, {"edge", &Maker::at_edge},
      {"along", &Maker::along_edge},  {"grazing", &Maker::grazing},  {"far", &Maker::far},
      {"axis", &Maker::by_axes},      {"leaving", &Maker::leaving}};
  const auto make = makers.at(kind);
  Maker maker(scene, seed);
  std::vector<FileRay> rays;
  rays.reserve(count);
  while (rays.size() < count) rays.push_back((maker.*make)());
  return rays;
}

}  // namespace trisect
