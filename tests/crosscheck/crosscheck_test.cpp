// Vulkan and OpenGL render the same frames: every model, surface, shell and solver at 320x240.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/cli/commands.h"
#include "app/crosscheck/frame_comparison.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/opengl/context.h"
#include "app/opengl/objects.h"
#include "app/opengl/tracer.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"
#include "vk/result.h"

namespace trisect {
namespace {

Frame trace_by_opengl(const BakedScene& scene, const TraceSettings& settings, GlPath path,
                      std::size_t buffer_limit = std::numeric_limits<std::size_t>::max()) {
  opengl::Tracer tracer(scene, settings.width, settings.height, {settings.solver, true, true}, path,
                        buffer_limit);
  Frame frame;
  tracer.render(make_params(scene, settings), frame);
  return frame;
}

BakedScene baked(const Mesh& mesh, const SurfaceChoice& choice, uint solver) {
  return solver == SOLVER_ROBUST ? bake_with_subpatches(mesh, choice) : bake(mesh, choice);
}

struct Combination {
  const char* name;
  SurfaceChoice choice;
  uint solver;
};

class Crosscheck : public test::GpuTest {
 protected:
  opengl::Context context_;
};

class CrosscheckMatrix : public Crosscheck, public ::testing::WithParamInterface<Combination> {};

TEST_P(CrosscheckMatrix, VulkanAndOpenGlAgree) {
  const Combination& combination = GetParam();
  for (const std::string& asset : test::asset_names()) {
#ifdef TRISECT_SLOW
    constexpr uint32_t width = 320;
#else
    // It takes a third of the time of all models and is left to the slow tests, like larger images.
    if (asset == "teapot-1000") continue;
    constexpr uint32_t width = 160;
#endif
    const Mesh mesh = test::load_asset(asset);
    const BakedScene scene = baked(mesh, combination.choice, combination.solver);
    TraceSettings settings = test::framed(mesh, scene, width, width * 3 / 4, 10);
    settings.solver = combination.solver;
    const Frame vulkan = test::trace(scene, settings);
    for (const GlPath path : {GlPath::compute, GlPath::fragment}) {
      const FrameComparison found = compare(vulkan, trace_by_opengl(scene, settings, path));
      Tolerance tolerance = tolerance_between(Backend::vulkan, Backend::opengl, path);
      // Whether the bisection finds a hit can depend on the last bit of the ray, which
      // interpolation changes: at Rank 10 for up to 6e-4 of the pixels. A lost pixel's colour is
      // off by up to 255 steps, so 1e-3 of them make an RMSE of up to 8.
      if (path == GlPath::fragment && combination.solver == SOLVER_BISECT) {
        tolerance = {1e-3, 5e-4, Tolerance::kAny, 8.1, Tolerance::kAny};
      }
      for (const std::string& excess : excesses(found, tolerance)) {
        ADD_FAILURE() << asset << (path == GlPath::compute ? ", compute: " : ", fragment: ")
                      << excess;
      }
      EXPECT_GT(found.hits, 1000U) << asset;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, CrosscheckMatrix,
    ::testing::Values(
        Combination{"flat_robust", {SURFACE_FLAT, 0.0, SHELL_NORMAL}, SOLVER_ROBUST},
        Combination{"flat_bisect", {SURFACE_FLAT, 0.0, SHELL_NORMAL}, SOLVER_BISECT},
        Combination{"phong_normal_robust", {SURFACE_PHONG, 0.65, SHELL_NORMAL}, SOLVER_ROBUST},
        Combination{"phong_normal_bisect", {SURFACE_PHONG, 0.65, SHELL_NORMAL}, SOLVER_BISECT},
        Combination{"phong_height_robust", {SURFACE_PHONG, 0.65, SHELL_HEIGHT}, SOLVER_ROBUST},
        Combination{"phong_height_bisect", {SURFACE_PHONG, 0.65, SHELL_HEIGHT}, SOLVER_BISECT},
        Combination{"sphere_normal_robust", {SURFACE_SPHERE, 0.65, SHELL_NORMAL}, SOLVER_ROBUST},
        Combination{"sphere_normal_bisect", {SURFACE_SPHERE, 0.65, SHELL_NORMAL}, SOLVER_BISECT},
        Combination{"sphere_height_robust", {SURFACE_SPHERE, 0.65, SHELL_HEIGHT}, SOLVER_ROBUST},
        Combination{"sphere_height_bisect", {SURFACE_SPHERE, 0.65, SHELL_HEIGHT}, SOLVER_BISECT}),
    [](const ::testing::TestParamInfo<Combination>& combination) {
      return combination.param.name;
    });

// Three triangles at places without symmetry, so that a mirrored, turned or shifted image is
// noticed. The camera is at z = 3 and looks along -z.
Mesh corners() {
  Mesh mesh;
  const auto add = [&](const glm::dvec3& at, double size) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {at, at + glm::dvec3(size, 0, 0), at + glm::dvec3(0, size, 0)});
    for (int i = 0; i < 3; ++i) mesh.normals.emplace_back(0.0, 0.0, 1.0);
    mesh.triangles.push_back({{first, first + 1, first + 2}, {first, first + 1, first + 2}});
  };
  add({0.2, 0.2, 0.0}, 0.7);    // upper right
  add({-0.8, 0.3, 0.3}, 0.4);   // upper left, nearer
  add({-0.7, -0.9, 0.0}, 0.3);  // lower left
  return mesh;
}

TEST_F(Crosscheck, ConventionsAreTheSame) {
  const Mesh mesh = corners();
  const BakedScene scene = baked(mesh, {SURFACE_FLAT, 0.0, SHELL_NORMAL}, SOLVER_ROBUST);
  for (const auto& size : {std::pair{64U, 48U}, {1U, 1U}, {1U, 37U}, {41U, 1U}, {13U, 17U}}) {
    const uint32_t width = size.first;
    const uint32_t height = size.second;
    TraceSettings settings = test::framed(mesh, scene, width, height, 10);
    settings.solver = SOLVER_ROBUST;
    settings.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45.0};
    const Frame vulkan = test::trace(scene, settings);
    const Frame compute = trace_by_opengl(scene, settings, GlPath::compute);
    const FrameComparison same = compare(vulkan, compute);
    EXPECT_EQ(same.hit_mismatches, 0U) << width << "x" << height;
    EXPECT_EQ(same.depth->patch_mismatches, 0U);
    EXPECT_EQ(same.depth->bit_equal, same.depth->pixels);
    EXPECT_LT(same.color_max, 1e-3);  // the gradient of the sky is rounded differently
    const Frame fragment = trace_by_opengl(scene, settings, GlPath::fragment);
    const FrameComparison found = compare(vulkan, fragment);
    EXPECT_EQ(found.hit_mismatches, 0U) << width << "x" << height;
    EXPECT_EQ(found.depth->patch_mismatches, 0U);
    // The interpolation of rays adds some units in the last place of their direction.
    EXPECT_LT(found.depth->ulp.max, 16.0);
    EXPECT_LT(found.color_max, 0.05);
    if (width != 64) continue;
    // The triangles are seen where they must be if x points right, y up, and rows count from the
    // top. 3 tan(22.5 degrees) is half of the image's height at z = 0.
    const auto triangle_at = [&](const Frame& frame, double x, double y) {
      const double pixels = 24.0 / (3.0 * std::tan(glm::radians(22.5)));
      const auto column = static_cast<uint32_t>(32.0 + x * pixels);
      const auto row = static_cast<uint32_t>(24.0 - y * pixels);
      return frame.aovs[row * width + column].triangle;
    };
    for (const Frame* frame : {&vulkan, &compute, &fragment}) {
      EXPECT_EQ(triangle_at(*frame, 0.4, 0.4), 0U);
      EXPECT_EQ(triangle_at(*frame, -0.75, 0.5), 1U);
      EXPECT_EQ(triangle_at(*frame, -0.62, -0.82), 2U);
      EXPECT_EQ(triangle_at(*frame, 0.4, -0.4), NO_TRIANGLE);
      // Z is the distance along the unit ray, not the depth along the camera's axis.
      const PixelAovs& aov = frame->aovs[24 * width + 40];
      if (aov.triangle == NO_TRIANGLE) continue;
      EXPECT_GT(aov.normal_z.w, 3.0F);
    }
  }
}

TEST_F(Crosscheck, ImagesComeInBands) {
  const Mesh mesh = test::load_asset("sphere-20");
  const BakedScene scene = baked(mesh, {}, SOLVER_ROBUST);
  TraceSettings settings = test::framed(mesh, scene, 200, 61, 10);
  settings.solver = SOLVER_ROBUST;
  for (const GlPath path : {GlPath::compute, GlPath::fragment}) {
    const Frame whole = trace_by_opengl(scene, settings, path);
    // The buffer holds 16 rows, so the image is rendered in four bands.
    const Frame banded =
        trace_by_opengl(scene, settings, path, std::size_t{200} * 20 * sizeof(PixelAovs));
    const FrameComparison found = compare(whole, banded);
    EXPECT_EQ(found.hit_mismatches, 0U);
    EXPECT_EQ(found.depth->patch_mismatches, 0U);
    // Each band has its own viewport, and rays are interpolated differently in it.
    EXPECT_LE(found.depth->ulp.max, path == GlPath::compute ? 0.0 : 16.0);
    EXPECT_LT(found.color_max, 0.05);
    EXPECT_GT(found.depth->pixels, 1000U);
  }
}

TEST_F(Crosscheck, RefusesWhatDoesNotFit) {
  const Mesh mesh = test::load_asset("sphere-20");
  const BakedScene scene = baked(mesh, {}, SOLVER_BISECT);
  EXPECT_THROW(opengl::Tracer(scene, 8, 8, {SOLVER_BISECT}, GlPath::compute, 19 * sizeof(Triangle)),
               gpu::Error);
  EXPECT_THROW(opengl::Tracer(scene, 16384, 8, {SOLVER_BISECT}, GlPath::fragment, 1U << 20U),
               gpu::Error);
}

TEST_F(Crosscheck, TellsALackOfOpenGLsMemory) {
  EXPECT_THROW(opengl::Buffer(std::size_t{1} << 46U, "huge"), OutOfMemory);
}

}  // namespace
}  // namespace trisect
