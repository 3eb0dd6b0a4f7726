#include "app/base/interval.h"

#include <gtest/gtest.h>

#include <random>

namespace trisect {
namespace {

// long double has eleven bits more than double: what rounding in double could lose, it keeps.
void expect_contains(const Interval& interval, long double exact) {
  EXPECT_LE(static_cast<long double>(interval.lo), exact);
  EXPECT_GE(static_cast<long double>(interval.hi), exact);
}

TEST(Interval, ContainsTheExactResultOfPoints) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> number(-3.0, 3.0);
  for (int i = 0; i < 100000; ++i) {
    const double a = number(random);
    const double b = number(random);
    const auto la = static_cast<long double>(a);
    const auto lb = static_cast<long double>(b);
    expect_contains(Interval(a) + b, la + lb);
    expect_contains(Interval(a) - b, la - lb);
    expect_contains(Interval(a) * b, la * lb);
    expect_contains(square(a), la * la);
    expect_contains(root(std::abs(a)), sqrtl(std::abs(la)));
    expect_contains(divide_by_positive(a, std::abs(b) + 0.1),
                    la / static_cast<long double>(std::abs(b) + 0.1));
  }
}

TEST(Interval, ContainsTheResultsOfEverythingInside) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-2.0, 2.0);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const auto interval = [&] {
    const double a = number(random);
    const double b = number(random);
    return Interval(std::min(a, b), std::max(a, b));
  };
  const auto inside = [&](const Interval& x) { return x.lo + (x.hi - x.lo) * part(random); };
  for (int i = 0; i < 100000; ++i) {
    const Interval x = interval();
    const Interval y = interval();
    const double a = inside(x);
    const double b = inside(y);
    expect_contains(x * y, static_cast<long double>(a) * static_cast<long double>(b));
    expect_contains(x - y, static_cast<long double>(a) - static_cast<long double>(b));
    expect_contains(square(x), static_cast<long double>(a) * static_cast<long double>(a));
    expect_contains(root(x), sqrtl(std::max(static_cast<long double>(a), 0.0L)));
  }
}

TEST(Interval, IsTight) {
  const Interval product = Interval(0.1) * 3.0;
  EXPECT_LT(product.hi - product.lo, 1e-15);
  EXPECT_EQ(square(Interval(-1.0, 2.0)).lo, 0.0);
  EXPECT_EQ(root(Interval(-1.0, -0.5)).lo, 0.0);
}

}  // namespace
}  // namespace trisect
