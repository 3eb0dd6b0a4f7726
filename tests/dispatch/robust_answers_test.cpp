// The two methods of the robust solver, each by itself, in single precision: rays through known
// points of a subpatch, and what must be true of an answer whatever the ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "app/bake/subpatch_bounds.h"
#include "app/stress/stress_scenes.h"
#include "app/surface/surface_double.h"
#include "app/surface/surface_float.h"
#include "app/surface/to_double.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// A root's point is off the ray by the roundings of its coordinates and, on a patch's border, by as
// much again.
constexpr double kTolerances = 4.0;

double least_of(const dvec3& v) {
  return std::min({v.x, v.y, v.z});
}

// A ray at the point of a subpatch's surface that has the weights l within the subpatch, from a
// point that lies `before` before it.
struct AimedRay {
  const BakedScene& scene;
  const SubpatchBounds& bounds;
  const Triangle& tri = scene.triangles[bounds.triangle];
  in_float::Shape shape{scene.choice.surface, scene.choice.shell,
                        static_cast<float>(scene.choice.alpha)};
  dvec3 l;
  dvec3 w = dvec3(bounds.sub_triangle) + l * static_cast<double>(bounds.sub_triangle.w);
  in_float::RayFrame frame{};
  in_float::FramedPatch framed{};
  float tolerance = 0.0F;

  AimedRay(const BakedScene& in, const SubpatchBounds& at, const dvec3& weights, const dvec3& view,
           double before)
      : scene(in), bounds(at), l(weights) {
    frame = in_float::ray_frame(vec3(point_at(w) - view * before), vec3(view));
    framed = in_float::sheared_patch(frame, in_float::rotated_patch(frame, shape.shell, tri));
    tolerance = in_float::position_tolerance(frame, tri);
  }

  [[nodiscard]] dvec3 point_at(const dvec3& weights) const {
    return in_double::surface_point(shape_of(scene.choice), to_double(tri), weights);
  }
  // Where on the ray, and how far from it, in tolerances.
  [[nodiscard]] double along(const dvec3& weights) const {
    return glm::dot(point_at(weights) - dvec3(frame.anchor), glm::normalize(dvec3(frame.z)));
  }
  [[nodiscard]] double across(const dvec3& weights) const {
    return glm::length(glm::cross(point_at(weights) - dvec3(frame.anchor),
                                  glm::normalize(dvec3(frame.z)))) /
           tolerance;
  }
  [[nodiscard]] double cosine(const dvec3& weights) const {
    const dvec3 normal =
        in_double::geometric_normal(shape_of(scene.choice), to_double(tri), weights);
    return std::abs(glm::dot(glm::normalize(normal), glm::normalize(dvec3(frame.z))));
  }
  [[nodiscard]] bool is_aimed_into_subpatch() const { return least_of(l) >= 0.0; }

  // The hit in a subpatch of the scene that is smooth, beyond `nearest`, by the search alone.
  [[nodiscard]] in_float::Hit search(const SubpatchBounds& in, float nearest) const {
    const Triangle& of = scene.triangles[in.triangle];
    in_float::Traversal traversal{};
    traversal.hit.z = in_float::NO_HIT_YET;
    traversal.hit.triangle = NO_TRIANGLE;
    traversal.path = in_float::WHOLE;
    traversal.steps = 1 << 20;
    in_float::search_subpatch(
        shape, false, of, in, 0, frame,
        in_float::sheared_patch(frame, in_float::rotated_patch(frame, shape.shell, of)),
        in_float::position_tolerance(frame, of), nearest, traversal);
    EXPECT_EQ(traversal.path, in_float::WHOLE);
    return traversal.hit;
  }
};

// Calls use(ray) with rays at points within subpatches, on their borders, on those of the nodes in
// them, and beside them.
template <typename Use>
void for_rays(std::mt19937_64& random, Use&& use) {
  struct Choice {
    const char* model;
    SurfaceChoice choice;
  };
  for (const Choice& choice : {Choice{"sphere-20", {SURFACE_PHONG, 0.65, SHELL_NORMAL}},
                               Choice{"torus", {SURFACE_PHONG, 0.65, SHELL_HEIGHT}},
                               Choice{"relief", {SURFACE_PHONG, 1.0, SHELL_NORMAL}},
                               Choice{"sphere-80", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}}}) {
    SCOPED_TRACE(choice.model);
    const BakedScene scene = bake_with_subpatches(test::load_asset(choice.model), choice.choice);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 100000; ++i) {
      const SubpatchBounds& bounds = scene.subpatches[random() % scene.subpatches.size()];
      const bool is_smooth = bounds.is_flat == 0 && bounds.gradient_lipschitz != NONSMOOTH;
      if (bounds.skip > 0 || !is_smooth) continue;
      dvec3 l(unit(random), unit(random), unit(random));
      const int k = static_cast<int>(random() % 3);
      const auto kind = random() % 4;
      if (kind == 1) l[k] = 0.0;
      l /= l.x + l.y + l.z;
      if (kind >= 2) {
        const double old = l[k];
        l[k] = kind == 2 ? std::round(l[k] * 8.0) / 8.0 : -std::pow(10.0, -6.0 * unit(random));
        l[(k + 1) % 3] += old - l[k];
      }
      const dvec3 view = stress::any_direction(random);
      const double before = (0.5 + 2.5 * unit(random)) * scene.radius;
      use(AimedRay(scene, bounds, l, view, before));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

// It decides for rays within the cone alone, and by a root in the enlarged subpatch.
TEST(RobustAnswers, OfTheQuickMethodAreRootsNearTheSubpatch) {
  std::mt19937_64 random(11);
  std::size_t found_roots = 0;
  std::size_t proven_misses = 0;
  for_rays(random, [&](const AimedRay& ray) {
    float z = 0.0F;
    vec3 weights(0.0F);
    uint evaluations = 0;
    const uint found =
        in_float::intersect_by_newton(ray.shape, ray.tri, ray.bounds, ray.framed, ray.frame.z,
                                      ray.tolerance, z, weights, evaluations);
    if (found == in_float::UNDECIDED) return;
    ASSERT_GT(std::abs(glm::dot(dvec3(ray.bounds.cone), dvec3(ray.frame.z))),
              ray.bounds.cone.w - 1e-6);
    const dvec3 within = (dvec3(weights) - dvec3(ray.bounds.sub_triangle)) /
                         static_cast<double>(ray.bounds.sub_triangle.w);
    ASSERT_GE(least_of(within), -CONE_MARGIN - 1e-5);
    ASSERT_LT(ray.across(dvec3(weights)), kTolerances);
    if (found == in_float::FOUND_ROOT) {
      ++found_roots;
      ASSERT_GE(least_of(dvec3(weights)), 0.0);
      ASSERT_LT(std::abs(z - ray.along(dvec3(weights))), kTolerances * ray.tolerance);
    } else {
      ++proven_misses;
      ASSERT_FALSE(ray.is_aimed_into_subpatch());
    }
  });
  EXPECT_GT(found_roots, 10000U);
  EXPECT_GT(proven_misses, 1000U);
}

// It finds the root that there is, if it is not before where the ray begins, or one in front of it.
TEST(RobustAnswers, OfTheSearchAreTheFirstRootOfTheSubpatch) {
  std::mt19937_64 random(12);
  std::size_t aimed = 0;
  std::size_t hits = 0;
  for_rays(random, [&](const AimedRay& ray) {
    const double at = ray.along(ray.w);
    // Some begin behind the point.
    const bool behind = random() % 4 == 0;
    const auto nearest =
        static_cast<float>(behind ? at + 0.01 * ray.scene.radius : at - 0.5 * ray.scene.radius);
    in_float::Hit hit = ray.search(ray.bounds, nearest);
    if (hit.triangle != NO_TRIANGLE) {
      ++hits;
      const dvec3 weights(hit.weights);
      ASSERT_GE(hit.z, nearest);
      ASSERT_GE(least_of(weights), 0.0);
      ASSERT_LT(ray.across(weights), kTolerances);
    }
    // Where it is all but tangent its root may be anywhere along it, or none.
    if (behind || !ray.is_aimed_into_subpatch() || least_of(ray.w) < 0.0 ||
        ray.cosine(ray.w) < 0.02) {
      return;
    }
    ++aimed;
    if (least_of(ray.w) == 0.0) {
      // Displaced by roundings the border is off the ray; then the neighbour has the root.
      for (const SubpatchBounds& bounds : ray.scene.subpatches) {
        if (bounds.skip > 0 || hit.triangle != NO_TRIANGLE) continue;
        hit = ray.search(bounds, nearest);
      }
    }
    ASSERT_NE(hit.triangle, NO_TRIANGLE);
    ASSERT_LT(hit.z, at + kTolerances * ray.tolerance / ray.cosine(ray.w));
  });
  EXPECT_GT(aimed, 10000U);
  EXPECT_GT(hits, aimed);
}

// A triangle is hit however thin it looks, as long as that is more than its coordinates round.
TEST(RobustAnswers, OfFlatTrianglesAreHitsAtAnySlant) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const BakedScene scene =
      bake_with_subpatches(test::load_asset("teapot"), {SURFACE_FLAT, 0.0, SHELL_NORMAL});
  std::size_t slanting = 0;
  for (int i = 0; i < 20000; ++i) {
    const SubpatchBounds& bounds = scene.subpatches[random() % scene.subpatches.size()];
    const dvec3 weights = glm::max(dvec3(unit(random), unit(random), unit(random)), 1e-2);
    // From all but level to steep.
    const dvec3 normal(scene.triangles[bounds.triangle].TriNormal);
    const dvec3 view = glm::normalize(stress::across(normal, random) +
                                      normal * std::pow(10.0, -5.0 * unit(random)));
    const AimedRay ray(scene, bounds, weights / (weights.x + weights.y + weights.z), view,
                       scene.radius);
    // How thin it looks.
    const glm::dvec2 u(ray.framed.P1 - ray.framed.P0);
    const glm::dvec2 v(ray.framed.P2 - ray.framed.P0);
    const double length = std::max(glm::length(u), glm::length(v));
    const double height = std::abs(u.x * v.y - u.y * v.x) / length;
    in_float::Hit hit{};
    hit.z = in_float::NO_HIT_YET;
    hit.triangle = NO_TRIANGLE;
    in_float::intersect_flat(ray.framed, bounds.triangle, 0, ray.tolerance, 0.0F, hit);
    if (height > 4.0 * ray.tolerance) {
      ASSERT_EQ(hit.triangle, bounds.triangle) << height / ray.tolerance;
      if (height < 1000.0 * ray.tolerance) ++slanting;
    }
    // Where it looks even thinner the determinant itself is mostly roundings.
    if (height > 100.0 * ray.tolerance) {
      ASSERT_LT(ray.across(dvec3(hit.weights)), kTolerances) << height / ray.tolerance;
    }
  }
  EXPECT_GT(slanting, 1000U);
}

}  // namespace
}  // namespace trisect
