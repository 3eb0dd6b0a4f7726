// Hard rays: at a closed sphere of 20 triangles, or at single patches.
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
  RayCase ray_case;
  ray_case.name = std::move(name);
  ray_case.what = std::move(what);
  ray_case.kind = StressKind::ray;
  ray_case.mesh = [] { return stress::sphere(); };
  ray_case.rays = std::move(rays);
  ray_case.closed = true;
  return ray_case;
}

RayCase on_patch(std::string name, std::string what, std::function<Mesh()> mesh, RayMaker rays) {
  RayCase ray_case = on_sphere(std::move(name), std::move(what), std::move(rays));
  ray_case.mesh = std::move(mesh);
  ray_case.closed = false;
  return ray_case;
}

// Into the sphere exactly through a vertex, in directions within a cone about the inward one.
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

// Into the sphere through points of a curved edge that two patches share.
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

// Along the edges' chords, and parallel to them through the middle of a curved edge.
Rays along_curved_edges(const BakedScene& scene) {
  Rays rays;
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const Triangle& tri = scene.triangles[t];
    const auto middle = stress::point_at(scene, t, {0.5, 0.5, 0.0});
    for (int i = 0; i < 3; ++i) {
      const dvec3 a(tri.Position[i]);
      const dvec3 b(tri.Position[(i + 1) % 3]);
      rays.push_back(stress::ray_exactly_through(scene, a, b - a));
      rays.push_back(stress::ray_exactly_through(scene, middle.position, b - a));
    }
  }
  return rays;
}

// A ray along the edge of a flat triangle lies in that triangle and has no first point with it,
// which leaves nothing to be decided. These lean inward by a thousandth, so that they come in above
// the edge and hit it in a point.
Rays almost_along_flat_edges(const BakedScene& scene) {
  Rays rays;
  for (const Triangle& tri : scene.triangles) {
    for (int i = 0; i < 3; ++i) {
      const dvec3 a(tri.Position[i]);
      const dvec3 b(tri.Position[(i + 1) % 3]);
      const dvec3 direction = b - a - 1e-3 * glm::normalize(a + b);
      for (const double part : {0.2, 0.5}) {
        rays.push_back(stress::ray_exactly_through(scene, a + part * (b - a), direction));
      }
    }
  }
  return rays;
}

Rays along_edges(const BakedScene& scene, std::mt19937_64& /*random*/) {
  return scene.choice.surface == SURFACE_FLAT ? almost_along_flat_edges(scene)
                                              : along_curved_edges(scene);
}

// A flat triangle in the plane z = 0, and one that stands upright at x = 2 and crosses that plane.
Mesh floor_and_wall() {
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

// Parallel to the base triangle, at fractions from `low` to `high` of the height of the surface
// above it.
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

// Along tangents at points of the surface, and parallel to tangents up to 0.01 above or below.
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

// Through two points of the surface, which is a single patch.
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

// Almost along the S-shaped edge, less steep than its middle and steeper than its ends: such rays
// hit the patch up to three times.
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

// Rays that begin at random distances along their line within the model: inside a patch's bounding
// ball, between patches, beyond all of them.
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

// Rays that begin on the surface, and next to it on either side.
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
    // Two components are zero in the first half of the rays, one in the second.
    if (i >= 150) direction[(i + 1) % 3] = 0.5;
    rays.push_back(
        stress::ray_through(scene, stress::any_point(scene, random).position, direction));
  }
  return rays;
}

// The angle to the surface is about the smallest at which the oracle decides any of these rays. A
// chord at the angle d to a sphere of radius 1 lies d^2 / 2 below the sphere, 5e-7 here; if that is
// less than the 1e-7 by which the oracle moves rays, a moved ray misses.
Rays far_and_grazing(const BakedScene& scene, std::mt19937_64& random) {
  Rays rays;
  for (int i = 0; i < 200; ++i) {
    const auto point = stress::any_point(scene, random);
    const dvec3 direction = stress::across(point.normal, random) - 1e-3 * point.normal;
    CastRay ray = stress::ray_through(scene, point.position, direction);
    ray.anchor.w = static_cast<float>(-1e4 * scene.radius);
    rays.push_back(ray);
  }
  return rays;
}

void add_single_patches(std::vector<RayCase>& cases) {
  const auto bulge = [] { return stress::leaning_patch(40.0); };
  cases.push_back(
      on_patch("in-plane-of-flat", "in the plane of a flat triangle", floor_and_wall, in_plane));
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
  cases.push_back(on_sphere("along-shared-edge",
                            "along an edge's chord, on flat triangles leaning by 1e-3 to it",
                            along_edges));
  // A sixth of the rays are tangents at the middle of a curved edge, which they just touch.
  cases.back().most_undecidable = 0.2;
  for (RayCase& ray_case : cases) ray_case.surfaces = {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE};
  add_single_patches(cases);
  cases.push_back(on_sphere("silhouette", "past the outline, as near as 1e-6", silhouettes));
  // A ninth of the rays are tangents that just touch the surface.
  cases.back().most_undecidable = 0.15;
  cases.push_back(
      on_sphere("starts-within", "begins in a patch's ball or in the model", from_within));
  cases.back().closed = false;
  cases.push_back(
      on_sphere("starts-on-surface", "begins on the surface or next to it", from_surface));
  cases.back().closed = false;
  // A fifth of the rays begin exactly on the surface: whether that is a hit is rounding's choice.
  cases.back().most_undecidable = 0.25;
  cases.push_back(on_sphere("axis-parallel", "directions with components of zero", along_axes));
  cases.push_back(
      on_sphere("far-grazing", "from 10,000 radii away at an angle of 1e-3", far_and_grazing));
  return cases;
}

}  // namespace trisect
