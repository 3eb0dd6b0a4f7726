// Hard scales: very small and very large models, far from the origin or from the eye, many patches
// along one ray; and the ranks of the bisection.
#include <fmt/format.h>

#include <cmath>

#include <utility>

#include "app/stress/stress_cases.h"
#include "app/stress/stress_scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

RayCase scale(std::string name, std::string what, std::function<Mesh()> mesh, int count = 200) {
  RayCase ray_case;
  ray_case.name = std::move(name);
  ray_case.what = std::move(what);
  ray_case.kind = StressKind::scale;
  ray_case.mesh = std::move(mesh);
  ray_case.rays = [count](const BakedScene& scene, std::mt19937_64& random) {
    return stress::rays_at_surface(scene, random, count);
  };
  ray_case.closed = true;
  return ray_case;
}

// 300 patches one above the other, each turned a little further about z.
Mesh stack() {
  Mesh mesh;
  for (int i = 0; i < 300; ++i) {
    const double turn = 0.1 * i;
    Mesh layer = stress::leaning_patch(i % 2 == 0 ? 20.0 : -20.0);
    const auto turned = [turn](const dvec3& p) {
      return dvec3(p.x * std::cos(turn) - p.y * std::sin(turn),
                   p.x * std::sin(turn) + p.y * std::cos(turn), p.z);
    };
    for (dvec3& p : layer.positions) p = turned(p - dvec3(0.0, 0.4, 0.0));
    for (dvec3& n : layer.normals) n = turned(n);
    mesh = stress::joined(mesh, layer, dvec3(0.0, 0.0, 0.02 * i));
  }
  return mesh;
}

std::vector<CastRay> through_stack(const BakedScene& scene, std::mt19937_64& random) {
  std::uniform_real_distribution<double> near(-0.05, 0.05);
  std::vector<CastRay> rays;
  rays.reserve(60);
  for (int i = 0; i < 60; ++i) {
    rays.push_back(stress::ray_through(scene, {near(random), near(random), 0.0},
                                       {near(random), near(random), i % 2 == 0 ? 1.0 : -1.0}));
  }
  return rays;
}

// The rays of a camera that is a million radii away.
std::vector<CastRay> from_afar(const BakedScene& scene, std::mt19937_64& random) {
  const dvec3 eye = stress::any_direction(random) * (1e6 * scene.radius);
  std::vector<CastRay> rays;
  for (int i = 0; i < 200; ++i) {
    const dvec3 target = stress::any_point(scene, random).position;
    CastRay ray = stress::ray_through(scene, target, target - eye);
    ray.anchor.w = static_cast<float>(-1e6 * scene.radius);
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace

std::vector<RayCase> stress_scale_cases() {
  std::vector<RayCase> cases;
  for (const auto& [name, size] :
       {std::pair{"size-1e-6", 1e-6}, {"size-1e-3", 1e-3}, {"size-1e3", 1e3}, {"size-1e6", 1e6}}) {
    cases.push_back(scale(name, "a sphere of that radius", [size = size] {
      return stress::moved(stress::sphere(), size, dvec3(0.0));
    }));
  }
  for (const auto& [name, place] : {std::pair{"at-1e5", 1e5}, {"at-1e6", 1e6}}) {
    cases.push_back(scale(name, "a sphere of radius 1 that far from the origin", [place = place] {
      return stress::moved(stress::sphere(), 1.0, dvec3(place, -0.7 * place, 0.4 * place));
    }));
  }
  cases.push_back(
      scale("eye-far-away", "seen from a million radii away", [] { return stress::sphere(); }));
  cases.back().rays = from_afar;
  cases.push_back(scale("hundreds-in-a-pixel", "300 patches one behind the other", stack));
  cases.back().rays = through_stack;
  cases.back().closed = false;
  cases.push_back(scale("many-in-a-pixel-sphere", "320 patches", [] { return stress::sphere(2); }));
  for (const uint32_t rank : {1U, 2U, 30U, 60U}) {
    cases.push_back(scale(fmt::format("rank-{}", rank), "the bisection at that rank",
                          [] { return stress::sphere(); }));
    cases.back().rank = rank;
  }
  return cases;
}

const char* kind_name(StressKind kind) {
  switch (kind) {
    case StressKind::shape:
      return "shape";
    case StressKind::ray:
      return "ray";
    case StressKind::scale:
      return "scale";
    case StressKind::image:
      return "image";
    case StressKind::data:
      return "data";
  }
  return "";
}

std::vector<RayCase> stress_ray_catalogue() {
  std::vector<RayCase> cases = stress_shape_cases();
  for (auto* more : {&stress_ray_cases, &stress_scale_cases}) {
    for (RayCase& ray_case : more()) cases.push_back(std::move(ray_case));
  }
  return cases;
}

}  // namespace trisect
