#include "app/frame/supersampling.h"

#include <gtest/gtest.h>

#include "app/picture/image_file.h"

namespace trisect {
namespace {

// Four by two pixels: a block with one white pixel that was hit, and one of a single colour.
Frame two_blocks() {
  Frame frame;
  frame.resize(4, 2, true);
  frame.colors[0] = vec4(1.0F);
  for (const std::size_t i : {2U, 3U, 6U, 7U}) frame.colors[i] = vec4(0.5F, 0.25F, 0.75F, 1.0F);
  for (std::size_t i = 0; i < frame.aovs.size(); ++i) {
    frame.aovs[i].triangle = static_cast<uint>(i);
    frame.aovs[i].evaluations = 10U;
    frame.aovs[i].candidates = 1U;
  }
  return frame;
}

TEST(Supersampling, CountsRaysOfARow) {
  EXPECT_EQ(samples_across(1), 1U);
  EXPECT_EQ(samples_across(9), 3U);
  EXPECT_EQ(samples_across(16), 4U);
}

TEST(Supersampling, AveragesLightNotItsCode) {
  const Frame frame = averaged(two_blocks(), 2);
  ASSERT_EQ(frame.width, 2U);
  ASSERT_EQ(frame.height, 1U);
  // A quarter of white light, encoded: IEC 61966-2-1.
  EXPECT_NEAR(frame.colors[0].x, 0.537099F, 1e-5);
  EXPECT_EQ(frame.colors[0].w, 0.25F);
  // The mean of equal colours is that colour, but for the roundings of code and light.
  EXPECT_NEAR(frame.colors[1].x, 0.5F, 1e-6);
  EXPECT_NEAR(frame.colors[1].y, 0.25F, 1e-6);
  EXPECT_NEAR(frame.colors[1].z, 0.75F, 1e-6);
}

TEST(Supersampling, TakesOnePixelsSurfaceAndAllPixelsWork) {
  const Frame frame = averaged(two_blocks(), 2);
  EXPECT_EQ(frame.aovs[0].triangle, 5U);
  EXPECT_EQ(frame.aovs[1].triangle, 7U);
  EXPECT_EQ(frame.aovs[0].evaluations, 40U);
  EXPECT_EQ(frame.aovs[1].candidates, 4U);
}

}  // namespace
}  // namespace trisect
