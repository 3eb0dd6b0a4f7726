#include "app/dispatch/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/base/error.h"
#include "app/dispatch/trace_settings.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec2;
using glm::dvec3;

// The kernel's ray direction through an image position, in double precision.
dvec3 direction(const TraceParams& params, double x, double y) {
  return glm::normalize(dvec3(params.ray_corner) + dvec3(params.ray_dx) * x +
                        dvec3(params.ray_dy) * y);
}

TraceParams rays(const Camera& camera, uint32_t width, uint32_t height,
                 const dvec3& origin = dvec3(0.0)) {
  TraceParams params{};
  params.image_width = width;
  params.image_height = height;
  set_rays(camera, origin, 1.0, 0.01, 100.0, params);
  return params;
}

// The vectors of TraceParams are rounded to single precision.
constexpr double kRounding = 3e-7;

TEST(Camera, LooksAtItsTarget) {
  const Camera camera{{3, 4, 5}, {-1, 2, 0.5}, {0, 1, 0}, 60.0};
  const TraceParams params = rays(camera, 640, 480);
  const dvec3 expected = glm::normalize(camera.target - camera.eye);
  EXPECT_LT(glm::distance(direction(params, 320.0, 240.0), expected), kRounding);
}

TEST(Camera, RowZeroIsOnTopAndColumnZeroOnTheLeft) {
  // Down the negative z axis with y up: x to the right.
  const TraceParams params = rays({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 90.0}, 200, 100);
  const dvec3 top_left = direction(params, 0.0, 0.0);
  EXPECT_LT(top_left.x, 0.0);
  EXPECT_GT(top_left.y, 0.0);
  // The field of view is vertical: the middle of the top row is 45 degrees up, and the middle of
  // the left column is twice as far from the axis.
  const double diagonal = std::sqrt(0.5);
  EXPECT_LT(glm::distance(direction(params, 100.0, 0.0), dvec3(0.0, diagonal, -diagonal)),
            kRounding);
  EXPECT_LT(glm::distance(direction(params, 0.0, 50.0), glm::normalize(dvec3(-2.0, 0.0, -1.0))),
            kRounding);
}

// The host's direction of a pixel is the kernels'.
TEST(ViewDirection, IsThatOfTheRays) {
  const Camera camera{{3, 4, 5}, {-1, 2, 0.5}, {0.2, 1, -0.3}, 60.0};
  const TraceParams params = rays(camera, 640, 480);
  for (const dvec2 at : {dvec2(0.5, 0.5), dvec2(639.5, 0.5), dvec2(12.5, 479.5), dvec2(320, 240)}) {
    EXPECT_LT(
        glm::distance(view_direction(camera, 640, 480, at.x, at.y), direction(params, at.x, at.y)),
        kRounding);
  }
}

TEST(Camera, KeepsWideAndNarrowFields) {
  for (const double fov : {1.0, 170.0}) {
    const TraceParams params = rays({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, fov}, 100, 100);
    const dvec3 top = direction(params, 50.0, 0.0);
    EXPECT_NEAR(glm::degrees(std::atan2(top.y, -top.z)), fov / 2.0, 1e-4);
  }
}

TEST(Camera, LosesNoDigitsFarFromTheOrigin) {
  const dvec3 away(1e7, 2e7, -3e7);
  const Camera near{{3, 4, 5}, {0, 1, 0}, {0, 1, 0}, 45.0};
  const Camera far{near.eye + away, near.target + away, near.up, near.fov};
  const TraceParams a = rays(near, 640, 480);
  const TraceParams b = rays(far, 640, 480, away);
  EXPECT_LT(glm::distance(dvec3(a.eye), dvec3(b.eye)), 1e-6);
  EXPECT_LT(glm::distance(direction(a, 10.5, 20.5), direction(b, 10.5, 20.5)), kRounding);
}

TEST(Camera, RefusesWhatIsNoCamera) {
  EXPECT_THROW(rays({{0, 0, 1}, {0, 0, 1}, {0, 1, 0}, 45.0}, 8, 8), UsageError);
  EXPECT_THROW(rays({{0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 45.0}, 8, 8), UsageError);
  EXPECT_THROW(rays({{0, 0, 1}, {0, 0, 0}, {0, 0, 0}, 45.0}, 8, 8), UsageError);
}

TEST(FramingCamera, LeavesAMarginAroundEveryModel) {
  for (const std::string& name : test::asset_names()) {
    const Mesh mesh = test::load_asset(name);
    const BakedScene scene = bake(mesh, {});
    for (const double aspect : {0.25, 1.0, 4.0 / 3.0, 5.0}) {
      for (const dvec3& up : {dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(1, -1, 0.5)}) {
        const Camera camera = framing_camera(mesh.positions, scene.origin, 45.0, up, aspect);
        const dvec3 forward = glm::normalize(camera.target - camera.eye);
        const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
        const dvec3 upward = glm::cross(right, forward);
        const double half = std::tan(glm::radians(22.5));
        double extent = 0.0;
        for (const dvec3& p : mesh.positions) {
          const dvec3 d = p - camera.eye;
          const double depth = glm::dot(d, forward);
          ASSERT_GT(depth, 0.0);
          extent = std::max({extent, std::abs(glm::dot(d, upward)) / (depth * half),
                             std::abs(glm::dot(d, right)) / (depth * half * aspect)});
        }
        EXPECT_NEAR(extent, 0.84, 1e-9) << name;
      }
    }
  }
}

TEST(MakeParams, SeesTheWholeSceneBetweenNearAndFar) {
  const Mesh mesh = test::load_asset("torus");
  const BakedScene scene = bake(mesh, {});
  TraceSettings settings;
  settings.camera = {{0, 0, 50}, {0, 0, 0}, {0, 1, 0}, 45.0};
  const TraceParams params = make_params(scene, settings);
  const double near = glm::length(dvec3(params.ray_corner)) * -direction(params, 0, 0).z;
  EXPECT_NEAR(near, scene.radius * 1e-3, 1e-7);
  EXPECT_GE(near * static_cast<double>(params.eye.w), (50.0 + scene.radius) * (1.0 - 1e-6));
  EXPECT_EQ(params.resolution, 1.0F / 1024.0F);
}

}  // namespace
}  // namespace trisect
