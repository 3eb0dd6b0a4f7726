// The projections of subpatches, against points of the surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "app/dispatch/kernel_float.h"
#include "app/dispatch/trace_settings.h"
#include "app/stress/stress_scenes.h"
#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"
#include "tests/support/baked_models.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// Pictures for projections, and where in them a point is.
struct View {
  TraceParams params;
  in_float::Kernel kernel;

  View(const BakedScene& scene, const dvec3& eye, const dvec3& target, uint32_t width = 640,
       uint32_t height = 480)
      : params(make_params(scene, settings(eye, target, width, height))),
        kernel(in_float::kernel_of(scene, params, {})) {}

  // In pixels; z is the depth along the axis. Nothing where the point is not before the eye.
  struct Seen {
    double z;
    std::optional<glm::dvec2> pixel;
  };
  [[nodiscard]] Seen at(const dvec3& point) const {
    const dvec3 S = point - dvec3(params.anchor);
    const double z = glm::dot(S, dvec3(params.frame_z));
    const double before = 1.0 + z / params.anchor.w;
    if (before <= 1e-3) return {z, {}};
    const glm::dvec2 middle(0.5 * params.image_width, 0.5 * params.image_height);
    return {z, middle + glm::dvec2(glm::dot(S, dvec3(params.frame_x)) / params.frame_x.w,
                                   glm::dot(S, dvec3(params.frame_y)) / params.frame_y.w) /
                            before};
  }

 private:
  static TraceSettings settings(const dvec3& eye, const dvec3& target, uint32_t width,
                                uint32_t height) {
    TraceSettings settings;
    settings.width = width;
    settings.height = height;
    settings.camera.eye = eye;
    settings.camera.target = target;
    return settings;
  }
};

// The image positions of points of the surface lie in the box and within the lines of the projected
// subpatch, and their depth is not less than the one at which it begins.
TEST(ProjectedSubpatch, HoldsTheImageOfTheSurface) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::size_t points = 0;
  double tightest = 1e30;
  for (const test::BakedModel& model : test::kBakedModels) {
    const BakedScene scene = test::baked(model);
    for (int camera = 0; camera < 6; ++camera) {
      const dvec3 from(unit(random), unit(random), unit(random));
      // Every other camera is inside the model.
      const dvec3 eye = scene.origin + from * scene.radius * (camera % 2 == 0 ? 4.0 : 0.5);
      View view(scene, eye, scene.origin + dvec3(unit(random), 0.1, 0.2) * scene.radius * 0.2);
      in_float::Kernel& kernel = view.kernel;
      for (uint32_t i = 0; i < scene.subpatches.size(); i += 7) {
        const SubpatchBounds& bounds = scene.subpatches[i];
        const ProjectedSubpatch seen = kernel.project_subpatch(i);
        ProjectedSubpatch balled = seen;
        kernel.bound_by_ball(bounds.ball, balled);
        for (const dvec3& l : test::weight_grid(4)) {
          const auto [z, pixel] = view.at(in_double::surface_point(
              shape_of(model.choice), to_double(scene.triangles[bounds.triangle]),
              test::weights_of(bounds, l)));
          EXPECT_GE(z, seen.lines_x.w);
          if (!pixel || std::max(std::abs(pixel->x), std::abs(pixel->y)) > 1e4) continue;
          const glm::dvec2 p = *pixel;
          ++points;
          ASSERT_TRUE(kernel.overlaps_rect(seen, glm::vec2(p), glm::vec2(kernel.PIXEL_SLACK)))
              << model.name << " subpatch " << i << " view " << camera << " at " << p.x << ", "
              << p.y;
          ASSERT_TRUE(kernel.overlaps_rect(balled, glm::vec2(p), glm::vec2(kernel.PIXEL_SLACK)));
          EXPECT_GE(z, balled.lines_x.w);
          tightest = std::min(tightest, double{seen.box.z} - p.x);
        }
      }
    }
  }
  EXPECT_GT(points, 10000U);
  // The box is no larger than it must be.
  EXPECT_LT(tightest, 0.5);
}

// Where the model is small in a large picture, the roundings of image positions are longer than all
// tolerances of the model.
TEST(ProjectedSubpatch, HoldsTheImageOfASmallModelInALargePicture) {
  std::mt19937_64 random(5);
  const test::BakedModel model{"sphere-320", {SURFACE_FLAT, 0.0, SHELL_NORMAL}};
  const BakedScene scene = test::baked(model);
  for (int camera = 0; camera < 20; ++camera) {
    View view(scene, scene.origin + stress::any_direction(random) * scene.radius * 600.0,
              scene.origin + stress::any_direction(random) * scene.radius, kLargestSide,
              kLargestSide);
    in_float::Kernel& kernel = view.kernel;
    for (uint32_t i = 0; i < scene.subpatches.size(); ++i) {
      const SubpatchBounds& bounds = scene.subpatches[i];
      const ProjectedSubpatch seen = kernel.project_subpatch(i);
      for (const dvec3& l : test::weight_grid(4)) {
        const auto [z, pixel] = view.at(in_double::surface_point(
            shape_of(model.choice), to_double(scene.triangles[bounds.triangle]),
            test::weights_of(bounds, l)));
        ASSERT_TRUE(pixel);
        ASSERT_TRUE(kernel.overlaps_rect(seen, glm::vec2(*pixel), glm::vec2(kernel.PIXEL_SLACK)))
            << "subpatch " << i << " view " << camera;
      }
    }
  }
}

// And so are the control points of its overlap, moved by the position error.
TEST(ProjectedSubpatch, HoldsTheImageOfItsControlPointsWithTheirError) {
  std::mt19937_64 random(4);
  std::size_t points = 0;
  const test::BakedModel model{"sphere-20", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}};
  const BakedScene scene = test::baked(model);
  for (int camera = 0; camera < 20; ++camera) {
    View view(scene, scene.origin + stress::any_direction(random) * scene.radius * 4.0,
              scene.origin);
    in_float::Kernel& kernel = view.kernel;
    for (uint32_t i = 0; i < scene.subpatches.size(); ++i) {
      const SubpatchBounds& bounds = scene.subpatches[i];
      const ProjectedSubpatch seen = kernel.project_subpatch(i);
      for (const dvec3& point : test::control_points_of(scene, bounds)) {
        const auto [z, pixel] =
            view.at(point + stress::any_direction(random) * double{bounds.corner.w});
        ASSERT_GE(z, seen.lines_x.w);
        ASSERT_TRUE(pixel);
        const glm::dvec2 p = *pixel;
        ++points;
        ASSERT_TRUE(kernel.overlaps_rect(seen, glm::vec2(p), glm::vec2(kernel.PIXEL_SLACK)))
            << "subpatch " << i << " view " << camera << " at " << p.x << ", " << p.y;
      }
    }
  }
  EXPECT_GT(points, 10000U);
}

}  // namespace
}  // namespace trisect
