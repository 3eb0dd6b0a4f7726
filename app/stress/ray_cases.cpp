// Hard rays, on a closed sphere of 20 triangles or on single patches.
#include <cmath>
#include <utility>

#include "app/oracle/oracle.h"
#include "app/stress/stress_cases.h"
#include "app/stress/stress_scenes.h"

namespace trisect {
namespace {

using glm::dvec3;
using Rays = std::vector<CastRay>;
using RayMaker = std::function<Rays(const BakedScene&, std::mt19937_64&)>;

RayCase on_sphere(std::string name, std::string what, RayMaker rays) {
  RayCase stress;
  stress.name = std::move(name);
  stress.what = std::move(what);
  stress.kind = StressKind::ray;
  stress.mesh = [] { return stress::sphere(); };
  stress.rays = std::move(rays);
  stress.closed = true;
  return stress;
}

RayCase on_patch(std::string name, std::string what, std::function<Mesh()> mesh, RayMaker rays) {
  RayCase stress = on_sphere(std::move(name), std::move(what), std::move(rays));
  stress.mesh = std::move(mesh);
  stress.closed = false;
  return stress;
}

// Into the solid at a vertex, from within a cone about the inward direction.
Rays through_vertices(const BakedScene& scene, std::mt19937_64& random) {
  Rays rays;
  for (const Triangle& tri : scene.triangles) {
    for (const vec4& position : tri.Position) {
      const dvec3 vertex(position);
      for (int i = 0; i < 4; ++i) {
        const dvec3 inward = -glm::normalize(vertex) + 0.7 * stress::any_direction(random);
        rays.push_back(stress::ray_exactly_through(scene, vertex, inward));
      }
    }
  }
  return rays;
}

// Through points of curved edges that two patches share.
Rays through_edges(const BakedScene& scene, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.02, 0.98);
  Rays rays;
  for (int i = 0; i < 300; ++i) {
    const double along = unit(random);
    const auto triangle = static_cast<uint32_t>(random() % scene.triangles.size());
    const auto point = stress::point_at(scene, triangle, {0.0, along, 1.0 - along});
    const dvec3 inward = -glm::normalize(point.position) + 0.7 * stress::any_direction(random);
    rays.push_back(i % 2 == 0 ? stress::ray_through(scene, point.position, inward)
                              : stress::ray_exactly_through(scene, point.position, inward));
  }
  return rays;
}

Rays along_edges(const BakedScene& scene, std::mt19937_64& /*random*/) {
  Rays rays;
  for (const Triangle& tri : scene.triangles) {
    for (int i = 0; i < 3; ++i) {
      const dvec3 a(tri.Position[i]);
      const dvec3 b(tri.Position[(i + 1) % 3]);
      rays.push_back(stress::ray_exactly_through(scene, a, b - a));
      // Along the curved edge's middle, as the chord of it is.
      const auto middle = stress::point_at(
          scene,
          static_cast<uint32_t>(rays.size() / 6) % static_cast<uint32_t>(scene.triangles.size()),
          {0.5, 0.5, 0.0});
      rays.push_back(stress::ray_exactly_through(scene, middle.position, b - a));
    }
  }
  return rays;
}

// Rays in the plane of a flat triangle that lies between two that stand on its edges.
Mesh gutter() {
  const dvec3 up(0, 0, 1);
  const Mesh floor = stress::plain_patch({up, up, up});
  const dvec3 side(1, 0, 0);
  const Mesh wall =
      stress::patch({dvec3(2, -2, -1), dvec3(2, 2, -1), dvec3(2, 0, 2)}, {side, side, side});
  return stress::joined(floor, wall, dvec3(0.0));
}

Rays in_plane(const BakedScene& scene, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.1, 0.9);
  Rays rays;
  const dvec3 a(scene.triangles[0].Position[0]);
  for (int i = 0; i < 100; ++i) {
    const dvec3 target = a + dvec3(unit(random), 0.3 * unit(random), 0.0);
    const double turn = 0.5 * unit(random);
    rays.push_back(
        stress::ray_exactly_through(scene, target, {std::cos(turn), std::sin(turn), 0.0}));
  }
  return rays;
}

// Parallel to the base at a part of the height of the surface's top.
Rays at_height(const BakedScene& scene, std::mt19937_64& random, double low, double high) {
  std::uniform_real_distribution<double> part(low, high);
  const auto middle = stress::point_at(scene, 0, dvec3(1.0 / 3.0));
  const dvec3 base =
      (dvec3(scene.triangles[0].Position[0]) + dvec3(scene.triangles[0].Position[1]) +
       dvec3(scene.triangles[0].Position[2])) /
      3.0;
  const dvec3 up(0, 0, 1);
  Rays rays;
  for (int i = 0; i < 120; ++i) {
    const dvec3 through = base + (middle.position - base) * part(random);
    rays.push_back(stress::ray_through(scene, through, stress::across(up, random)));
  }
  return rays;
}

// Past points of the surface along their tangent planes, and up to 0.01 in or out.
Rays silhouettes(const BakedScene& scene, std::mt19937_64& random) {
  Rays rays;
  for (const double off : {0.0, 1e-6, -1e-6, 1e-5, -1e-5, 1e-4, -1e-4, 1e-2, -1e-2}) {
    for (int i = 0; i < 30; ++i) {
      const auto point = stress::any_point(scene, random);
      rays.push_back(stress::ray_through(scene, point.position + point.normal * off,
                                         stress::across(point.normal, random)));
    }
  }
  return rays;
}

// Two points of one patch.
Rays through_two_points(const BakedScene& scene, std::mt19937_64& random) {
  Rays rays;
  while (rays.size() < 200) {
    const auto a = stress::any_point(scene, random);
    const auto b = stress::any_point(scene, random);
    if (glm::distance(a.position, b.position) < 1e-3 * scene.radius) continue;
    rays.push_back(stress::ray_through(scene, a.position, b.position - a.position));
  }
  return rays;
}

Mesh s_shaped() {
  const dvec3 leaning(0.5, 0, 1);
  return stress::plain_patch({leaning, -leaning, dvec3(0, 0, 1)});
}

// Almost along the S, less steep than its middle and steeper than its ends.
Rays through_three_points(const BakedScene& scene, std::mt19937_64& random) {
  std::uniform_real_distribution<double> near(-0.02, 0.02);
  Rays rays;
  const dvec3 middle =
      (dvec3(scene.triangles[0].Position[0]) + dvec3(scene.triangles[0].Position[1])) * 0.5;
  for (int i = 0; i < 100; ++i) {
    const dvec3 direction(i % 2 == 0 ? 1.0 : -1.0, near(random), 0.3 + near(random));
    const dvec3 target(near(random), 0.05 + near(random), near(random));
    rays.push_back(stress::ray_through(scene, middle + target,
                                       {direction.x, direction.y, direction.z * direction.x}));
  }
  return rays;
}

// Begin between a patch's ball and the patch, or anywhere in the model.
Rays from_within(const BakedScene& scene, std::mt19937_64& random) {
  Rays rays;
  for (int i = 0; i < 200; ++i) {
    CastRay ray = stress::ray_through(scene, stress::any_point(scene, random).position,
                                      stress::any_direction(random));
    std::uniform_real_distribution<float> start(-static_cast<float>(scene.radius),
                                                static_cast<float>(scene.radius));
    ray.anchor.w = start(random);
    rays.push_back(ray);
  }
  return rays;
}

// Begin on the surface, and next to it on either side.
Rays from_surface(const BakedScene& scene, std::mt19937_64& random) {
  Rays rays;
  for (const double off : {0.0, 1e-5, -1e-5, 1e-3, -1e-3}) {
    for (int i = 0; i < 60; ++i) {
      const auto point = stress::any_point(scene, random);
      const dvec3 direction = stress::any_direction(random);
      CastRay ray = stress::ray_exactly_through(scene, point.position, direction);
      ray.anchor.w = static_cast<float>(off * scene.radius);
      rays.push_back(ray);
    }
  }
  return rays;
}

Rays along_axes(const BakedScene& scene, std::mt19937_64& random) {
  Rays rays;
  for (int i = 0; i < 300; ++i) {
    dvec3 direction(0.0);
    direction[i % 3] = i % 2 == 0 ? 1.0 : -1.0;
    // Every other one has a single component of zero.
    if (i >= 150) direction[(i + 1) % 3] = 0.5;
    rays.push_back(
        stress::ray_through(scene, stress::any_point(scene, random).position, direction));
  }
  return rays;
}

Rays far_and_grazing(const BakedScene& scene, std::mt19937_64& random) {
  Rays rays;
  for (int i = 0; i < 200; ++i) {
    const auto point = stress::any_point(scene, random);
    const dvec3 direction = stress::across(point.normal, random) - 1e-4 * point.normal;
    CastRay ray = stress::ray_through(scene, point.position, direction);
    ray.anchor.w = static_cast<float>(-1e4 * scene.radius);
    rays.push_back(ray);
  }
  return rays;
}

void add_single_patches(std::vector<RayCase>& cases) {
  const auto bulge = [] { return stress::leaning_patch(40.0); };
  cases.push_back(
      on_patch("in-plane-of-flat", "in the plane of a flat triangle", gutter, in_plane));
  cases.back().most_rays = 12;
  cases.back().surfaces = {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE};
  cases.push_back(on_patch("parallel-to-base", "parallel to the base, through the bulge", bulge,
                           [](const BakedScene& scene, std::mt19937_64& random) {
                             return at_height(scene, random, 0.05, 1.2);
                           }));
  cases.push_back(
      on_patch("two-roots", "through two points of one patch", bulge, through_two_points));
  cases.push_back(
      on_patch("three-roots", "an S that rays meet three times", s_shaped, through_three_points));
  cases.back().surfaces = {SURFACE_PHONG};
  cases.back().alpha = 3.0;
  cases.push_back(on_patch(
      "through-the-walls", "in and out through the shell's side walls",
      [] { return stress::leaning_patch(20.0); },
      [](const BakedScene& scene, std::mt19937_64& random) {
        return at_height(scene, random, -0.3, 0.6);
      }));
}

}  // namespace

std::vector<RayCase> stress_ray_cases() {
  std::vector<RayCase> cases;
  cases.push_back(
      on_sphere("through-vertex", "through a vertex, to the last bit", through_vertices));
  cases.push_back(on_sphere("through-shared-edge", "through a curved edge that two patches share",
                            through_edges));
  cases.push_back(on_sphere("along-shared-edge", "along an edge's chord", along_edges));
  for (RayCase& stress : cases) stress.surfaces = {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE};
  add_single_patches(cases);
  cases.push_back(on_sphere("silhouette", "past the outline, as near as 1e-6", silhouettes));
  cases.push_back(
      on_sphere("starts-within", "begins in a patch's ball or in the model", from_within));
  cases.back().closed = false;
  cases.push_back(
      on_sphere("starts-on-surface", "begins on the surface or next to it", from_surface));
  cases.back().closed = false;
  cases.push_back(on_sphere("axis-parallel", "directions with components of zero", along_axes));
  cases.push_back(
      on_sphere("far-grazing", "from 10,000 radii away at an angle of 1e-4", far_and_grazing));
  return cases;
}

}  // namespace trisect
