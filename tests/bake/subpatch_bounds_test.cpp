// The bounds of subpatches, against points of the surface.
#include "app/bake/subpatch_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "app/bake/subpatch_boxes.h"
#include "app/bake/subpatch_fit.h"
#include "app/surface/control_net.h"
#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"
#include "tests/support/baked_models.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// Directions on the border of a subpatch's cone, all around its axis.
std::array<dvec3, 16> cone_border(const SubpatchBounds& bounds) {
  const dvec3 n(bounds.cone);
  const dvec3 x = glm::normalize(std::abs(n.x) < 0.5 ? glm::cross(n, {1.0, 0.0, 0.0})
                                                     : glm::cross(n, {0.0, 1.0, 0.0}));
  const dvec3 y = glm::cross(n, x);
  const double cosine = bounds.cone.w;
  const double sine = std::sqrt(1.0 - cosine * cosine);
  std::array<dvec3, 16> border{};
  for (std::size_t k = 0; k < border.size(); ++k) {
    const double angle = static_cast<double>(k) * std::acos(-1.0) / 8.0;
    border[k] = n * cosine + (x * std::cos(angle) + y * std::sin(angle)) * sine;
  }
  return border;
}

// No line within a subpatch's cone is tangent to the enlarged subpatch: S_u, S_v and the line keep
// their orientation.
TEST(SubpatchBounds, LinesWithinItsConeCrossTheSubpatchOneWay) {
  std::size_t cones = 0;
  for (const test::BakedModel& model : test::kBakedModels) {
    const BakedScene scene = test::baked(model);
    for (const SubpatchBounds& bounds : scene.subpatches) {
      if (bounds.cone.w == NO_CONE) continue;
      ++cones;
      const in_double::Triangle tri = to_double(scene.triangles[bounds.triangle]);
      const in_double::Shape shape = shape_of(model.choice);
      const std::array<dvec3, 16> border = cone_border(bounds);
      for (const dvec3& l : test::weight_grid(6)) {
        const dvec3 w =
            test::weights_of(bounds, l * (1.0 + 3.0 * CONE_MARGIN) - dvec3(double{CONE_MARGIN}));
        const dvec3 normal = in_double::geometric_normal(shape, tri, w);
        const double side = glm::dot(normal, dvec3(bounds.cone));
        for (const dvec3& d : border) {
          ASSERT_GT(glm::dot(normal, d) * side, 0.0)
              << model.name << " triangle " << bounds.triangle;
        }
      }
    }
  }
  EXPECT_GT(cones, 1000U);
}

// Nor is any surface whose tangents are off those of the quadratic by the tangent error, each pair
// of them by the worst that there is for lines on the cone's border.
TEST(SubpatchBounds, LinesWithinItsConeCrossWhateverIsWithinTheTangentError) {
  std::size_t cones = 0;
  const test::BakedModel model{"teapot", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}};
  const BakedScene scene = test::baked(model);
  for (const SubpatchBounds& bounds : scene.subpatches) {
    if (bounds.cone.w == NO_CONE) continue;
    ++cones;
    const in_double::SubTriangle large =
        in_double::enlarged(test::sub_triangle_of(bounds), double{CONE_MARGIN});
    const auto [u, v] = tangent_net(patch_of(model.choice.shell, scene.triangles[bounds.triangle]),
                                    test::quadratic_of(bounds), large);
    const double error = double{bounds.edge.w} * std::abs(large.size) / 3.0;
    const dvec3 n(bounds.cone);
    for (const dvec3& d : cone_border(bounds)) {
      for (std::size_t i = 0; i < 6; ++i) {
        // The volume of u, v and d is linear in either of the tangents: each is moved against its
        // gradient, as far as it may be.
        const double whole = glm::dot(glm::cross(u[i], v[i]), d);
        const double side = whole * glm::dot(glm::cross(u[0], v[0]), n) > 0.0 ? 1.0 : -1.0;
        dvec3 moved_u = u[i];
        dvec3 moved_v = v[i];
        for (int step = 0; step < 4; ++step) {
          moved_u = u[i] - glm::normalize(glm::cross(moved_v, d)) * (side * error);
          moved_v = v[i] - glm::normalize(glm::cross(d, moved_u)) * (side * error);
        }
        const double room = glm::dot(glm::cross(moved_u, moved_v), d) / whole;
        ASSERT_GT(room, 0.0) << "triangle " << bounds.triangle;
      }
    }
  }
  EXPECT_GT(cones, 1000U);
}

// Points of a subpatch and of its overlap: the surface and its tangents differ from those of T + q
// D by no more than the errors, and the surface lies in the ball.
TEST(SubpatchBounds, HoldTheSurface) {
  std::mt19937_64 random(5);
  std::size_t nonsmooth = 0;
  double most_of_position_error = 0.0;
  double most_of_tangent_error = 0.0;
  for (const test::BakedModel& model :
       {test::BakedModel{"sphere-20", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}},
        test::BakedModel{"relief", {SURFACE_SPHERE, 0.0, SHELL_HEIGHT}},
        test::BakedModel{"saddle", {SURFACE_SPHERE, 0.0, SHELL_HEIGHT}},
        test::BakedModel{"torus", {SURFACE_PHONG, 0.65, SHELL_HEIGHT}},
        test::BakedModel{"teapot", {SURFACE_SPHERE, 0.0, SHELL_HEIGHT}},
        test::BakedModel{"wild", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}}}) {
    const BakedScene scene = test::baked(model);
    const in_double::Shape shape = shape_of(model.choice);
    for (std::size_t k = 0; k < scene.subpatches.size(); ++k) {
      const SubpatchBounds& bounds = scene.subpatches[k];
      if (bounds.skip > 0) continue;
      // All that are nonsmooth, every third of the others.
      if (bounds.gradient_lipschitz == NONSMOOTH) {
        ++nonsmooth;
      } else if (k % 3 != 0) {
        continue;
      }
      const in_double::Triangle tri = to_double(scene.triangles[bounds.triangle]);
      const Patch corners = patch_of(shape.shell, scene.triangles[bounds.triangle]);
      const DisplacementQuadratic q = test::quadratic_of(bounds);
      for (int i = 0; i < 10; ++i) {
        const dvec3 l = test::random_weights(random);
        const dvec3 w =
            test::weights_of(bounds, l * (1.0 + 3.0 * OVERLAP) - dvec3(double{OVERLAP}));
        const test::QuadraticErrors errors = test::errors_of(q, shape, tri, corners, w);
        ASSERT_LE(errors.position, bounds.corner.w) << model.name << " subpatch " << k;
        const dvec3 S = in_double::surface_point(shape, tri, w);
        ASSERT_LE(glm::distance(S, dvec3(bounds.ball)), bounds.ball.w)
            << model.name << " subpatch " << k;
        if (bounds.gradient_lipschitz == NONSMOOTH) continue;
        ASSERT_LE(errors.tangents, bounds.edge.w) << model.name << " subpatch " << k;
        most_of_position_error =
            std::max(most_of_position_error, errors.position / bounds.corner.w);
        most_of_tangent_error = std::max(most_of_tangent_error, errors.tangents / bounds.edge.w);
      }
    }
  }
  EXPECT_GT(nonsmooth, 1000U);
  // The largest difference of the bake's samples is two thirds of an error. At points between the
  // samples it is not much larger, so most of the margin is left for points that no test sees.
  EXPECT_LT(most_of_position_error, 0.75);
  EXPECT_LT(most_of_tangent_error, 0.85);
}

// What the fit is in double precision, the bounds have in single precision, rounded up.
TEST(SubpatchBounds, AreNoLessThanTheErrorsOfTheirFit) {
  const SurfaceChoice choice{SURFACE_SPHERE, 0.0, SHELL_NORMAL};
  const BakedScene scene = test::baked({"sphere-80", choice});
  std::size_t rounded = 0;
  for (const SubpatchBounds& bounds : scene.subpatches) {
    const Triangle& tri = scene.triangles[bounds.triangle];
    const Fit fit =
        fit_subpatch({shape_of(choice), to_double(tri), patch_of(choice.shell, tri), dvec3(0.0)},
                     test::sub_triangle_of(bounds));
    ASSERT_GE(double{bounds.corner.w}, fit.position_error);
    ASSERT_GE(double{bounds.edge.w}, fit.tangent_error);
    ASSERT_GE(double{bounds.gradient_lipschitz}, fit.gradient_lipschitz);
    if (double{static_cast<float>(fit.position_error)} < fit.position_error) ++rounded;
  }
  EXPECT_GT(rounded, 100U);
}

// A subpatch's box holds what its control points with their error and its ball have in common, and
// the slack for a ray's roundings around that.
TEST(SubpatchBoxes, HoldControlPointsWithTheirErrorAndTheSlack) {
  for (const test::BakedModel& model : test::kBakedModels) {
    const BakedScene scene = test::baked(model);
    const std::vector<SubpatchBox> boxes = subpatch_boxes(scene);
    const dvec3 slack(double{BVH_SLACK} * scene.radius);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const SubpatchBounds& bounds = scene.subpatches[i];
      const dvec3 error(bounds.corner.w);
      const dvec3 lowest = dvec3(bounds.ball) - dvec3(bounds.ball.w);
      const dvec3 highest = dvec3(bounds.ball) + dvec3(bounds.ball.w);
      for (const dvec3& point : test::control_points_of(scene, bounds)) {
        const dvec3 lo = glm::clamp(point - error, lowest, highest) - slack;
        const dvec3 hi = glm::clamp(point + error, lowest, highest) + slack;
        for (int k = 0; k < 3; ++k) {
          ASSERT_LE(double{boxes[i].lo[k]}, lo[k]) << model.name << " subpatch " << i;
          ASSERT_GE(double{boxes[i].hi[k]}, hi[k]) << model.name << " subpatch " << i;
        }
      }
    }
  }
}

// The bake says how many triangles are done, all of them at the end, and ends where it is told to.
TEST(SubpatchBounds, TellHowManyAreMade) {
  const Mesh mesh = test::load_asset("sphere-320");
  const SurfaceChoice choice{SURFACE_PHONG, 0.65, SHELL_NORMAL};
  std::vector<uint32_t> told;
  const auto scene = bake_with_subpatches(mesh, choice, [&](uint32_t done) {
    told.push_back(done);
    return true;
  });
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->subpatches.size(), bake_with_subpatches(mesh, choice).subpatches.size());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 320U);
  EXPECT_FALSE(bake_with_subpatches(mesh, choice, [](uint32_t) { return false; }));
}

}  // namespace
}  // namespace trisect
