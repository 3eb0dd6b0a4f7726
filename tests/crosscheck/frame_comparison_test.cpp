// The comparison of two frames, on frames that are made by hand.
#include "app/crosscheck/frame_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/base/error.h"

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

TEST(FrameComparison, RefusesFramesOfOtherSizes) {
  EXPECT_THROW(compare(grey(4, 3), grey(3, 4)), InputError);
  EXPECT_THROW(comparison_picture(grey(4, 3), grey(3, 4)), InputError);
}

}  // namespace
}  // namespace trisect
