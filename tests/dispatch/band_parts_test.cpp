// Every workgroup of a band is traced once, within the budget of a submit.
#include "app/dispatch/band_parts.h"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

namespace trisect {
namespace {

using Part = BandParts::Part;

// As text: "c3+5 s0+2" are camera rays of the workgroups 3 to 7, shadow rays of 0 and 1.
std::string text_of(const std::vector<Part>& parts) {
  std::string text;
  for (const Part& part : parts) {
    if (!text.empty()) text += " ";
    text +=
        (part.shadows ? "s" : "c") + std::to_string(part.first) + "+" + std::to_string(part.count);
  }
  return text;
}

TEST(BandParts, FillTheBudgetAndKeepTheLimit) {
  const BandParts band({3, 13}, {0, 0});
  EXPECT_EQ(text_of(band.next(100, 100)), "c3+10");
  EXPECT_EQ(text_of(band.next(4, 100)), "c3+4");
  EXPECT_EQ(text_of(band.next(100, 4)), "c3+4 c7+4 c11+2");
  EXPECT_EQ(text_of(band.next(7, 4)), "c3+4 c7+3");
}

TEST(BandParts, OfShadowRaysComeAfterAllCameraRays) {
  const BandParts band({3, 13}, {3, 13});
  EXPECT_EQ(text_of(band.next(100, 100)), "c3+10 s3+10");
  EXPECT_EQ(text_of(band.next(12, 100)), "c3+10 s3+2");
}

TEST(BandParts, GoOnAfterThoseThatAreTraced) {
  BandParts band({0, 10}, {0, 10});
  const std::vector<Part> parts = band.next(100, 4);
  // The third part was not begun.
  EXPECT_EQ(band.part_done(), 0.0);
  EXPECT_EQ(band.finish(std::span(parts).first(2)), 8U);
  EXPECT_EQ(band.part_done(), 8.0 / 20.0);
  EXPECT_EQ(text_of(band.next(100, 4)), "c8+2 s0+4 s4+4 s8+2");
  EXPECT_FALSE(band.is_done());
  band.finish(band.next(100, 4));
  EXPECT_TRUE(band.is_done());
  EXPECT_EQ(band.part_done(), 1.0);
  EXPECT_EQ(text_of(band.next(100, 4)), "");
}

// Which tiles have a list is known when a submit is over that counted on more.
TEST(BandParts, CountOnlyTheTilesThatThereAre) {
  BandParts band({0, 100}, {0, 10});
  const std::vector<Part> parts = band.next(60, 50);
  EXPECT_EQ(text_of(parts), "c0+50 c50+10");
  band.end_camera_at(53);
  EXPECT_EQ(band.finish(parts), 53U);
  EXPECT_EQ(band.part_done(), 53.0 / 63.0);
  EXPECT_EQ(text_of(band.next(60, 50)), "s0+10");
}

TEST(BandParts, AreNoneOfAnEmptySky) {
  BandParts band({0, 100}, {0, 0});
  const std::vector<Part> parts = band.next(60, 50);
  band.end_camera_at(0);
  EXPECT_EQ(band.finish(parts), 0U);
  EXPECT_TRUE(band.is_done());
}

}  // namespace
}  // namespace trisect
