#include "app/base/ulp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trisect {
namespace {

TEST(Ulp, IsTheDistanceOfFloats) {
  EXPECT_EQ(ulp_of(1.5), 0x1p-23);
  EXPECT_EQ(ulp_of(-1.5), 0x1p-23);
  EXPECT_EQ(ulp_of(3.0), 0x1p-22);
  // At a power of two the floats below are the nearer ones.
  EXPECT_EQ(ulp_of(1.0), 0x1p-24);
  EXPECT_EQ(ulp_of(1.0 + 0x1p-30), 0x1p-23);
  EXPECT_EQ(ulp_of(0x1.fffffep127), 0x1p104);
  // Of denormals it is the least denormal.
  EXPECT_EQ(ulp_of(0x1p-126), 0x1p-149);
  EXPECT_EQ(ulp_of(0x1p-140), 0x1p-149);
  EXPECT_EQ(ulp_of(0.0), 0x1p-149);
}

TEST(Ulp, CountsTheErrorInThem) {
  EXPECT_EQ(ulp_error(1.5F, 1.5), 0.0);
  EXPECT_EQ(ulp_error(1.5F, 1.5 + 0x1p-24), 0.5);
  EXPECT_EQ(ulp_error(std::nextafter(1.5F, 2.0F), 1.5), 1.0);
  EXPECT_EQ(ulp_error(-1.5F, 1.5), 0x1p23 * 3.0);
  EXPECT_EQ(ulp_error(std::numeric_limits<float>::infinity(), 1.5),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(ulp_error(std::nanf(""), 1.5), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace trisect
