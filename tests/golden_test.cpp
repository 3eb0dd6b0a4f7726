// Small frames kept in the repository, against which every change is held. scripts/update-golden.sh
// makes them anew, for a change that is meant to change them.
#include <gtest/gtest.h>

#include "app/image_file.h"
#include "tests/support/exr_reader.h"
#include "tests/support/frame_difference.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

struct Golden {
  const char* model;
  uint surface;
  const char* surface_name;
};

class GoldenFrame : public test::GpuTest, public ::testing::WithParamInterface<Golden> {};

// As `trisect render --size 48x36 --rank 24` makes it.
Frame fresh(const Golden& golden) {
  const Mesh mesh = test::load_asset(golden.model);
  const BakedScene scene = bake(mesh, {golden.surface, 0.65});
  return test::trace(scene, test::framed(mesh, scene, 48, 36, 24));
}

void expect_same(const Frame& kept, Frame frame) {
  for (vec4& color : frame.colors) {
    for (int k = 0; k < 3; ++k) color[k] = linear_from_srgb(color[k]);
  }
  const test::FrameDifference d = test::difference(kept, frame);
  ASSERT_TRUE(d.same_size);
  EXPECT_EQ(d.hit_mismatches, 0U);
  EXPECT_EQ(d.patch_mismatches, 0U);
  // Another driver's roundings: single precision at a depth of up to 12, and at Rank 24 a march
  // that ends where the field's rounding, some 1e-6, decides the last steps.
  EXPECT_LE(d.depth, 2e-5);
  EXPECT_LE(d.weights, 2e-4);
  EXPECT_LE(d.normal_degrees, 0.02);
  // Half of one step of 8 bits; but a pixel on a grid line's flank goes from dark to light over
  // 1e-2 of the scene.
  EXPECT_LE(d.color, 4e-3);
}

TEST_P(GoldenFrame, IsReproduced) {
  const Golden& golden = GetParam();
  const std::string name = std::string(golden.model) + "-" + golden.surface_name + ".exr";
  expect_same(test::read_exr(std::filesystem::path(TRISECT_GOLDEN) / name), fresh(golden));
}

INSTANTIATE_TEST_SUITE_P(Assets, GoldenFrame,
                         ::testing::Values(Golden{"sphere-20", SURFACE_PHONG, "phong"},
                                           Golden{"sphere-20", SURFACE_SPHERE, "sphere"},
                                           Golden{"torus", SURFACE_PHONG, "phong"},
                                           Golden{"saddle", SURFACE_FLAT, "flat"}),
                         [](const ::testing::TestParamInfo<Golden>& golden) {
                           std::string name =
                               std::string(golden.param.model) + "_" + golden.param.surface_name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// The comparison itself: one pixel off, in whatever way, is noticed.
TEST(FrameDifference, NoticesOnePixel) {
  const Frame kept = test::read_exr(std::filesystem::path(TRISECT_GOLDEN) / "sphere-20-phong.exr");
  const std::size_t middle = 18 * 48 + 24;
  ASSERT_NE(kept.aovs[middle].triangle, NO_TRIANGLE);
  const auto changed = [&](auto change) {
    Frame frame = kept;
    change(frame.colors[middle], frame.aovs[middle]);
    return test::difference(kept, frame);
  };
  EXPECT_EQ(test::difference(kept, kept).color, 0.0);
  EXPECT_EQ(changed([](vec4&, PixelAovs& aov) { aov.triangle = NO_TRIANGLE; }).hit_mismatches, 1U);
  EXPECT_EQ(changed([](vec4& color, PixelAovs&) { color.w = 0.0F; }).hit_mismatches, 1U);
  EXPECT_EQ(changed([](vec4&, PixelAovs& aov) { ++aov.triangle; }).patch_mismatches, 1U);
  EXPECT_GT(changed([](vec4&, PixelAovs& aov) { aov.normal_z.w += 1e-4F; }).depth, 9e-5);
  EXPECT_GT(changed([](vec4&, PixelAovs& aov) { aov.normal_z.x += 0.01F; }).normal_degrees, 0.1);
  EXPECT_GT(changed([](vec4&, PixelAovs& aov) { aov.geometric_u.y += 0.01F; }).normal_degrees, 0.1);
  EXPECT_GT(changed([](vec4&, PixelAovs& aov) { aov.v += 0.001F; }).weights, 9e-4);
  EXPECT_GT(changed([](vec4& color, PixelAovs&) { color.y += 0.005F; }).color, 4.9e-3);
  const float nan = std::nanf("");
  EXPECT_FALSE(changed([&](vec4&, PixelAovs& aov) { aov.normal_z.w = nan; }).depth <= 1e9);
  EXPECT_FALSE(changed([&](vec4& color, PixelAovs&) { color.x = nan; }).color <= 1e9);
  Frame narrow = kept;
  narrow.width -= 1;
  EXPECT_FALSE(test::difference(kept, narrow).same_size);
}

}  // namespace
}  // namespace trisect
