// What colours a frame has, on every back end.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/trace_settings.h"
#include "app/trace/trace_scene.h"
#include "tests/support/frame_difference.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::vec3;

class Shading : public test::GpuTest {
 protected:
  Shading()
      : mesh_(test::load_asset("torus")),
        scene_(bake_with_subpatches(mesh_, {SURFACE_PHONG, 0.65, SHELL_NORMAL})),
        settings_(test::framed(mesh_, scene_, 80, 60, 10)) {
    scene_.bvh = build_bvh(scene_);
    settings_.solver = SOLVER_ROBUST;
  }

  // To two of three triangles.
  void give_colors() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      mesh_.colors.push_back(t % 3 == 0   ? vec3(1, 0, 0)
                             : t % 3 == 1 ? vec3(0, 1, 0.5F)
                                          : vec3(-1.0F));
    }
    scene_ = bake_with_subpatches(mesh_, scene_.choice);
    scene_.bvh = build_bvh(scene_);
  }

  // The frame of a back end.
  Frame traced(Backend backend, bool shadows = false) {
    const TraceParams params = make_params(scene_, settings_);
    TraceRequest request;
    request.backend = backend;
    return trace_scene(request, scene_, params,
                       {SOLVER_ROBUST, true, false,
                        backend == Backend::vulkan ? Accel::tiles : Accel::list, shadows})
        ->frame;
  }

  Mesh mesh_;
  BakedScene scene_;
  TraceSettings settings_;
};

vec3 color_at(const Frame& frame, std::size_t pixel) {
  return vec3(frame.colors[pixel]);
}

TEST_F(Shading, ShowsNormalsPatchesAndDepths) {
  settings_.background = Background::color;
  settings_.background_color = {0.1, 0.2, 0.3};
  const TraceParams params = make_params(scene_, settings_);
  for (const uint shading : {SHADING_NORMAL, SHADING_PATCH, SHADING_DEPTH}) {
    SCOPED_TRACE(shading_name(shading));
    settings_.shading = shading;
    const Frame frame = traced(Backend::vulkan);
    std::set<std::tuple<float, float, float>> patch_colors;
    std::set<uint> patches;
    for (std::size_t i = 0; i < frame.colors.size(); ++i) {
      const vec3 color = color_at(frame, i);
      const PixelAovs& aovs = frame.aovs[i];
      if (aovs.triangle == NO_TRIANGLE) {
        EXPECT_EQ(color, vec3(0.1F, 0.2F, 0.3F));
      } else if (shading == SHADING_NORMAL) {
        EXPECT_LT(glm::distance(color, vec3(aovs.normal_z) * 0.5F + 0.5F), 1e-6F);
      } else if (shading == SHADING_DEPTH) {
        const float depth =
            (aovs.normal_z.w - params.depth_low) / (params.depth_high - params.depth_low);
        EXPECT_LT(glm::distance(color, vec3(1.0F - depth)), 1e-5F);
        EXPECT_GT(depth, 0.0F);
        EXPECT_LT(depth, 1.0F);
      } else {
        patch_colors.emplace(color.x, color.y, color.z);
        patches.insert(aovs.triangle);
      }
    }
    EXPECT_EQ(patch_colors.size(), patches.size());
  }
}

TEST_F(Shading, LightsAPlainSurfaceInItsColour) {
  settings_.color = {1.0, 0.5, 0.0};
  const Frame frame = traced(Backend::vulkan);
  const vec3 light = glm::normalize(vec3(settings_.light));
  std::size_t hits = 0;
  float brightest = 0.0F;
  for (std::size_t i = 0; i < frame.colors.size(); ++i) {
    if (frame.colors[i].w == 0.0F) continue;
    ++hits;
    const vec3 color = color_at(frame, i);
    // The highlight is white; where no light falls there is none.
    const float highlight = color.z;
    const vec3 normal(frame.aovs[i].normal_z);
    const float lambert = std::max(glm::dot(normal, light), 0.0F);
    brightest = std::max(brightest, highlight);
    if (lambert == 0.0F) {
      EXPECT_EQ(highlight, 0.0F);
    }
    // Linear light is some of the light from all around, and what falls on it at this angle.
    const float root = color.x - highlight;
    EXPECT_NEAR(root * root, 0.1F + 0.06F * normal.y + 0.84F * lambert, 1e-5F);
    EXPECT_NEAR(color.y - highlight, 0.5F * root, 1e-6F);
  }
  EXPECT_GT(brightest, 0.25F);
  EXPECT_LE(brightest, 0.3F);
  EXPECT_GT(hits, 500U);
}

// Of the file, unless the user chose one; on a plain surface only.
TEST_F(Shading, TakesTheColoursOfTriangles) {
  give_colors();
  const Frame own = traced(Backend::vulkan);
  settings_.own_colors = false;
  const Frame chosen = traced(Backend::vulkan);
  std::array<std::size_t, 3> seen{};
  for (std::size_t i = 0; i < own.colors.size(); ++i) {
    const uint triangle = own.aovs[i].triangle;
    if (triangle == NO_TRIANGLE) continue;
    ++seen[triangle % 3];
    // The same light on another colour.
    const vec3 difference = color_at(chosen, i) - color_at(own, i);
    const vec3 expected = triangle % 3 == 0   ? vec3(settings_.color) - vec3(1, 0, 0)
                          : triangle % 3 == 1 ? vec3(settings_.color) - vec3(0, 1, 0.5F)
                                              : vec3(0.0F);
    EXPECT_LT(glm::length(glm::cross(difference, expected)), 1e-5F);
    EXPECT_EQ(glm::length(difference) > 0.05F, triangle % 3 < 2);
  }
  EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 100U);
  settings_.own_colors = true;
  settings_.shading = SHADING_GRID;
  const Frame grid = traced(Backend::vulkan);
  settings_.own_colors = false;
  test::expect_equal(grid, traced(Backend::vulkan), "grid");
}

TEST_F(Shading, IsTheSameOnEveryBackEnd) {
  give_colors();
  for (const uint shading :
       {SHADING_PLAIN, SHADING_GRID, SHADING_NORMAL, SHADING_PATCH, SHADING_DEPTH}) {
    SCOPED_TRACE(shading_name(shading));
    settings_.shading = shading;
    settings_.color = standard_color(shading);
    settings_.background = shading == SHADING_GRID ? Background::none : Background::sky;
    const bool shadows = is_lit(shading);
    const Frame vulkan = traced(Backend::vulkan, shadows);
    for (const Backend backend : {Backend::opengl, Backend::cpu, Backend::oracle}) {
      SCOPED_TRACE(backend_name(backend));
      const test::FrameDifference d = test::difference(vulkan, traced(backend, shadows));
      EXPECT_EQ(d.hit_mismatches, 0U);
      // For the oracle the border of a grid's line may be on another side of a pixel's centre.
      EXPECT_LE(d.color, backend == Backend::oracle && shading == SHADING_GRID ? 1.0 : 1e-4);
    }
  }
}

// Where the light does not come there is what comes from all around, in the triangle's colour.
TEST_F(Shading, LeavesShapeInShadows) {
  give_colors();
  settings_.light = glm::dvec3(-1.0, -0.3, -0.2);
  const Frame lit = traced(Backend::vulkan);
  const Frame shaded = traced(Backend::vulkan, true);
  std::size_t in_shadow = 0;
  for (std::size_t i = 0; i < lit.colors.size(); ++i) {
    const PixelAovs& aovs = shaded.aovs[i];
    if (aovs.triangle == NO_TRIANGLE) continue;
    const vec3 own = aovs.triangle % 3 == 0   ? vec3(1, 0, 0)
                     : aovs.triangle % 3 == 1 ? vec3(0, 1, 0.5F)
                                              : vec3(settings_.color);
    const vec3 left = own * std::sqrt(0.1F + 0.06F * aovs.normal_z.y);
    if (glm::distance(color_at(shaded, i), left) < 1e-5F) {
      ++in_shadow;
    } else {
      EXPECT_EQ(color_at(shaded, i), color_at(lit, i));
    }
  }
  EXPECT_GT(in_shadow, 500U);
}

// A number for everything that can be seen, from however far away.
TEST_F(Shading, OfDepthIsANumberFromAnywhere) {
  settings_.shading = SHADING_DEPTH;
  settings_.camera.eye = settings_.camera.target + glm::dvec3(1e9, 0.0, 0.0);
  settings_.camera.fov = 1e-6;
  settings_.width = settings_.height = 1;
  const TraceParams params = make_params(scene_, settings_);
  EXPECT_GT(params.depth_high, params.depth_low);
}

TEST_F(Shading, LeavesABackgroundThatIsNoneBlack) {
  settings_.background = Background::none;
  const Frame frame = traced(Backend::vulkan);
  for (const vec4& color : frame.colors) {
    if (color.w == 0.0F) {
      EXPECT_EQ(color, vec4(0.0F));
    }
  }
  EXPECT_LT(frame.hits(), frame.colors.size());
}

}  // namespace
}  // namespace trisect
