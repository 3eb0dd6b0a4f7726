// The comparison of two frames, on frames that are made by hand.
#include "app/crosscheck/frame_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/base/error.h"
#include "app/base/ulp.h"
#include "app/crosscheck/comparison_picture.h"

namespace trisect {
namespace {

// All pixels grey and hit, without AOVs.
Frame grey(uint32_t width, uint32_t height) {
  Frame frame;
  frame.resize(width, height, false);
  for (vec4& color : frame.colors) color = vec4(0.5F, 0.5F, 0.5F, 1.0F);
  return frame;
}

TEST(FrameComparison, MeasuresColoursInStepsOf8Bits) {
  const Frame a = grey(4, 3);
  Frame b = a;
  b.colors[5].y += 0.1F;
  const FrameComparison found = compare(a, b);
  EXPECT_NEAR(found.color_max, 25.5, 1e-5);
  EXPECT_NEAR(found.color_rmse, 25.5 / std::sqrt(36.0), 1e-5);
  EXPECT_EQ(found.hit_mismatches, 0U);
  EXPECT_FALSE(found.depth);
}

// Wherever the NaN is: the pixels after it must not hide it.
TEST(FrameComparison, KeepsANan) {
  const Frame a = grey(4, 3);
  for (std::size_t i = 0; i < a.colors.size(); ++i) {
    Frame b = a;
    b.colors[i].x = std::numeric_limits<float>::quiet_NaN();
    const FrameComparison found = compare(a, b);
    EXPECT_TRUE(std::isnan(found.color_max)) << i;
    EXPECT_TRUE(std::isnan(found.color_rmse)) << i;
    // One excess for each of the two, though the tolerance allows any number.
    EXPECT_EQ(excesses(found, {}).size(), 2U) << i;
  }
  EXPECT_TRUE(excesses(compare(a, a), {}).empty());
}

// Pictures are equal to themselves, but what two back ends should not have made is told.
TEST(FrameComparison, CallsWhatIsNoNumberInBothEqual) {
  Frame a = grey(4, 3);
  a.resize(4, 3, true);
  for (PixelAovs& pixel : a.aovs) {
    pixel = PixelAovs{};
    pixel.normal_z.w = std::numeric_limits<float>::quiet_NaN();
    pixel.geometric_u.x = std::numeric_limits<float>::quiet_NaN();
  }
  a.colors[2].y = std::numeric_limits<float>::quiet_NaN();
  a.colors[3].x = std::numeric_limits<float>::infinity();
  a.colors[4].w = std::numeric_limits<float>::quiet_NaN();
  const FrameComparison found = compare(a, a);
  EXPECT_EQ(found.color_max, 0.0);
  EXPECT_EQ(found.color_rmse, 0.0);
  EXPECT_EQ(found.alpha_max, 0.0);
  EXPECT_EQ(found.nan_pixels, 1U);
  EXPECT_EQ(found.depth->z_apart.max, 0.0);
  EXPECT_TRUE(excesses(found, {}).empty());
  EXPECT_EQ(excesses(found, {.nan_pixels = 0.0}).size(), 1U);
  EXPECT_NE(to_text(found).find("1 pixels are NaN in both"), std::string::npos);
  Frame b = a;
  b.colors[3].x = -b.colors[3].x;
  EXPECT_EQ(compare(a, b).color_max, std::numeric_limits<double>::infinity());
}

TEST(FrameComparison, ComparesAlpha) {
  const Frame a = grey(4, 3);
  Frame b = a;
  b.colors[7].w = 0.2F;
  const FrameComparison found = compare(a, b);
  EXPECT_NEAR(found.alpha_max, 204.0, 1e-4);
  EXPECT_EQ(found.color_max, 0.0);
  EXPECT_TRUE(excesses(found, {}).empty());
  EXPECT_EQ(excesses(found, {.alpha_max = 1.0}).size(), 1U);
  // A hit of one only is counted as that.
  b.colors[7].w = 0.0F;
  EXPECT_EQ(compare(a, b).alpha_max, 0.0);
  EXPECT_EQ(compare(a, b).hit_mismatches, 1U);
  b.colors[7].w = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(excesses(compare(a, b), {}).size(), 1U);
}

TEST(FrameComparison, PicturesAmplifyTheLargestDifferenceThatIsANumber) {
  const Frame a = grey(4, 3);
  Frame b = a;
  b.colors[1].y += 0.125F;
  b.colors[2].y += 0.25F;
  b.colors[3].y = std::numeric_limits<float>::quiet_NaN();
  // Below a.
  const Frame picture = comparison_picture(a, b);
  EXPECT_EQ(picture.colors[3 * 8 + 0].y, 0.0F);
  EXPECT_EQ(picture.colors[3 * 8 + 1].y, 0.5F);
  EXPECT_EQ(picture.colors[3 * 8 + 2].y, 1.0F);
}

TEST(FrameComparison, SaysHowFarZIsApartAsALengthToo) {
  Frame a = grey(2, 1);
  a.resize(2, 1, true);
  for (PixelAovs& pixel : a.aovs) {
    pixel = PixelAovs{};
    pixel.normal_z = vec4(0.0F, 0.0F, 1.0F, 4.0F);
    pixel.geometric_u = vec4(0.0F, 0.0F, 1.0F, 0.0F);
  }
  Frame b = a;
  b.aovs[1].normal_z.w = 4.5F;
  const FrameComparison found = compare(a, b);
  EXPECT_EQ(found.depth->z_apart.max, 0.5);
  EXPECT_EQ(found.depth->ulp.max, 0.5 / ulp_of(4.0F));
  EXPECT_NE(to_text(found).find("0.5 max in the model's units"), std::string::npos);
}

// A picture without alpha does not say where a surface is.
TEST(FrameComparison, TellsOfHitsOnlyWhereImagesDo) {
  Frame a = grey(4, 3);
  EXPECT_EQ(to_text(compare(a, a)).find("hit"), std::string::npos);
  a.colors[3].w = 0.0F;
  EXPECT_NE(to_text(compare(a, a)).find("11 hit, 0 hit mismatches"), std::string::npos);
}

TEST(ComparisonPicture, SaysThatADifferenceIsNotFinite) {
  const Frame a = grey(4, 3);
  Frame b = a;
  EXPECT_EQ(comparison_scale(a, b), "no difference");
  b.colors[0].x = 1.0F;
  EXPECT_EQ(comparison_scale(a, b), "128 of 255, x2");
  b.colors[5].x = std::numeric_limits<float>::infinity();
  EXPECT_EQ(comparison_scale(a, b), "128 of 255, x2, some not finite");
  b.colors[6].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(comparison_scale(a, b), "128 of 255, x2, some not finite");
}

// Letters are drawn, and what does not fit into a frame is left out.
TEST(ComparisonPicture, HasAKey) {
  for (const uint32_t side : {1U, 7U, 300U}) {
    const Frame a = grey(side, side);
    Frame b = a;
    b.colors[0].x = 0.75F;
    const Frame picture = comparison_picture(a, b);
    ASSERT_EQ(picture.width, 2 * side);
    ASSERT_EQ(picture.height, 2 * side + kComparisonKeyHeight);
    std::size_t white = 0;
    std::size_t yellow = 0;
    for (std::size_t i = std::size_t{2} * side * picture.width; i < picture.colors.size(); ++i) {
      white += picture.colors[i] == vec4(1.0F) ? 1 : 0;
      yellow += picture.colors[i] == vec4(1.0F, 1.0F, 0.0F, 1.0F) ? 1 : 0;
    }
    if (side < 300) continue;
    EXPECT_GT(white, 200U);  // the letters
    EXPECT_EQ(yellow, 64U);
  }
}

TEST(FrameComparison, RefusesFramesOfOtherSizes) {
  EXPECT_THROW(compare(grey(4, 3), grey(3, 4)), InputError);
  EXPECT_THROW(comparison_picture(grey(4, 3), grey(3, 4)), InputError);
}

}  // namespace
}  // namespace trisect
