#include "app/base/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace trisect {
namespace {

// Not less than the number, and none in single precision lies between.
TEST(Rounding, GoesToTheNextNumberInSinglePrecision) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-30.0, 30.0);
  std::uniform_real_distribution<double> sign(-1.0, 1.0);
  for (int i = 0; i < 10000; ++i) {
    const double x = std::copysign(std::exp2(exponent(random)), sign(random));
    const float up = rounded_up(x);
    ASSERT_GE(double{up}, x);
    ASSERT_LT(double{std::nextafterf(up, -std::numeric_limits<float>::infinity())}, x);
    const float down = rounded_down(x);
    ASSERT_LE(double{down}, x);
    ASSERT_GT(double{std::nextafterf(down, std::numeric_limits<float>::infinity())}, x);
  }
  EXPECT_EQ(rounded_up(1.5), 1.5F);
  EXPECT_EQ(rounded_down(1.5), 1.5F);
  EXPECT_EQ(rounded_up(1e300), std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace trisect
