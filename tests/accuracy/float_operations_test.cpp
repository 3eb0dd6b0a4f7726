// The judge of a device's arithmetic, given what devices could make of the items.
#include "app/accuracy/float_operations.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "app/buffers/float_operations.h"

namespace trisect {
namespace {

constexpr float kInfiniteFloat = std::numeric_limits<float>::infinity();

// A device that does as IEEE 754 says, unless a member is set.
struct FakeDevice {
  bool flushes = false;    // denormal operands and results to 0
  bool contracts = false;  // where it may
  bool contracts_always = false;
  bool rounds_down = false;  // to 0
  bool folds = false;        // what is known if there were no NaN, infinity and -0
  float quotient_factor = 1.0F;
  bool moves_denormals_as_zero = false;

  [[nodiscard]] float in(uint32_t bits) const {
    const auto x = std::bit_cast<float>(bits);
    return flushes && std::fpclassify(x) == FP_SUBNORMAL ? std::copysign(0.0F, x) : x;
  }

  [[nodiscard]] float out(double exact, float nearest) const {
    float x = nearest;
    if (rounds_down && std::isfinite(nearest) && std::fabs(nearest) > std::fabs(exact)) {
      x = std::nextafter(nearest, 0.0F);
    }
    return flushes && std::fpclassify(x) == FP_SUBNORMAL ? std::copysign(0.0F, x) : x;
  }

  [[nodiscard]] uint32_t moved(uint32_t bits) const {
    const bool denormal = std::fpclassify(std::bit_cast<float>(bits)) == FP_SUBNORMAL;
    return moves_denormals_as_zero && denormal ? bits & 0x80000000U : bits;
  }

  [[nodiscard]] FloatResults results_of(const std::vector<FloatItem>& items) const {
    FloatResults results;
    for (const FloatItem& item : items) {
      const float a = in(item.a);
      const float b = in(item.b);
      const float c = in(item.c);
      std::vector<uint32_t> row(FLOAT_RESULTS);
      const auto put = [&](uint32_t result, float x) { row[result] = std::bit_cast<uint32_t>(x); };
      const double x = a;
      const double y = b;
      put(FLOAT_ADD, out(x + y, a + b));
      put(FLOAT_SUBTRACT, out(x - y, a - b));
      put(FLOAT_MULTIPLY, out(x * y, a * b));
      put(FLOAT_DIVIDE, a / b);
      put(FLOAT_SQRT, std::sqrt(a));
      put(FLOAT_INVERSESQRT, static_cast<float>(1.0 / std::sqrt(x)));
      put(FLOAT_FMA, std::fma(a, b, c));
      const float product = a * b;
      put(FLOAT_MULTIPLY_ADD, contracts_always ? std::fma(a, b, c) : product + c);
      put(FLOAT_DIVIDE_AGAIN, a / b);
      put(FLOAT_DIVIDE_VECTOR, a * quotient_factor / b);
      put(FLOAT_RECIPROCAL_VECTOR, 1.0F / b);
      put(FLOAT_RECIPROCAL, 1.0F / b);
      put(FLOAT_MIN, std::isnan(a) || b < a ? b : a);
      put(FLOAT_MAX, std::isnan(a) || a < b ? b : a);
      put(FLOAT_MINUS_ITSELF, folds ? 0.0F : a - a);
      put(FLOAT_TIMES_ZERO, folds ? 0.0F : a * 0.0F);
      put(FLOAT_PLUS_ZERO, folds ? a : a + 0.0F);
      row[FLOAT_BITS] = moved(item.a);
      uint32_t tests = 0;
      tests |= std::isnan(a) ? FLOAT_IS_NAN | FLOAT_DIFFERS : 0U;
      tests |= std::isinf(a) ? FLOAT_IS_INF : 0U;
      tests |= a == b ? FLOAT_EQUAL : 0U;
      tests |= a < b ? FLOAT_LESS : 0U;
      tests |= a >= b ? FLOAT_AT_LEAST : 0U;
      tests |= !(a < b) && !(folds && !(a >= b)) ? FLOAT_NOT_LESS : 0U;
      tests |= !(a >= b) ? FLOAT_NOT_AT_LEAST : 0U;
      row[FLOAT_TESTS] = tests;
      results.operations.insert(results.operations.end(), row.begin(), row.end());
      for (const uint32_t bits : {item.a, item.b, item.c}) results.copies.push_back(moved(bits));
      const float plain = contracts || contracts_always ? std::fma(a, b, c) : product + c;
      results.plain.push_back(std::bit_cast<uint32_t>(plain));
    }
    for (const uint32_t bits : denormals_to_send()) {
      results.broadcast.insert(results.broadcast.end(), FLOATS_SIZE, moved(bits));
    }
    return results;
  }

  [[nodiscard]] FloatReport report() const {
    const std::vector<FloatItem> items = float_items();
    return judge_floats(items, results_of(items));
  }
};

void expect_all(const Share& share, std::size_t least) {
  EXPECT_EQ(share.yes, share.of);
  EXPECT_GE(share.of, least);
}

void expect_none(const Share& share) {
  EXPECT_EQ(share.yes, 0U);
  EXPECT_GT(share.of, 0U);
}

// Its items are hard enough to come near half an ulp, and there are enough for every row.
TEST(FloatReport, OfIeee754) {
  const FloatReport report = FakeDevice().report();
  EXPECT_EQ(report.items % FLOATS_SIZE, 0U);
  for (const LargestError& largest : {report.add, report.subtract, report.multiply, report.divide,
                                      report.sqrt, report.inversesqrt, report.fma}) {
    EXPECT_GE(largest.items, 2000U);
    EXPECT_LE(largest.ulp, 0.5 + 1e-8);  // double precision's own rounding
    EXPECT_GE(largest.ulp, 0.49999);
  }
  expect_all(report.nearest_even, 10000);
  expect_all(report.fma_fused, 1000);
  expect_none(report.precise_contracted);
  expect_none(report.plain_contracted);
  expect_all(report.division_repeats, 2000);
  expect_all(report.denormal_operands, 200);
  expect_all(report.denormal_results, 200);
  expect_all(report.denormal_copies, 500);
  ASSERT_TRUE(report.denormal_broadcast);
  expect_all(*report.denormal_broadcast, 10000);
  expect_all(report.nan_tests, 50);
  expect_all(report.nan_results, 100);
  expect_all(report.nan_lost_by_min_max, 50);
  expect_all(report.infinities, 200);
  expect_all(report.division_by_zero, 10);
  expect_all(report.signed_zeros, 50);
  expect_all(report.not_folded, 500);
  expect_all(report.bits, 2000);
}

TEST(FloatReport, TellsContraction) {
  const FloatReport plain = FakeDevice{.contracts = true}.report();
  expect_all(plain.plain_contracted, 1000);
  expect_none(plain.precise_contracted);
  expect_all(FakeDevice{.contracts_always = true}.report().precise_contracted, 1000);
}

TEST(FloatReport, TellsFlushedDenormals) {
  const FloatReport flushed = FakeDevice{.flushes = true}.report();
  expect_none(flushed.denormal_operands);
  expect_none(flushed.denormal_results);
  expect_all(flushed.denormal_copies, 500);
  // All else is as it was.
  EXPECT_LE(flushed.add.ulp, 0.5 + 1e-8);
  EXPECT_LE(flushed.multiply.ulp, 0.5 + 1e-8);
  expect_all(flushed.nearest_even, 10000);
  expect_all(flushed.nan_lost_by_min_max, 50);
  expect_all(flushed.signed_zeros, 50);
  const FloatReport moved = FakeDevice{.moves_denormals_as_zero = true}.report();
  expect_none(moved.denormal_copies);
  expect_none(*moved.denormal_broadcast);
  EXPECT_LT(moved.bits.yes, moved.bits.of);
  expect_all(moved.denormal_operands, 200);
}

TEST(FloatReport, TellsRoundingToZero) {
  const FloatReport report = FakeDevice{.rounds_down = true}.report();
  for (const LargestError& largest : {report.add, report.multiply}) {
    EXPECT_LT(largest.ulp, 1.0);
    EXPECT_GT(largest.ulp, 0.99);
  }
  EXPECT_LT(report.nearest_even.yes, report.nearest_even.of * 3 / 4);
}

TEST(FloatReport, TellsWhatIsFoldedAndWhatDoesNotRepeat) {
  const FloatReport folded = FakeDevice{.folds = true}.report();
  expect_none(folded.not_folded);
  EXPECT_LT(folded.nan_tests.yes, folded.nan_tests.of);
  const FloatReport rough = FakeDevice{.quotient_factor = 1.0F + 0x1p-23F}.report();
  EXPECT_LT(rough.division_repeats.yes, rough.division_repeats.of / 10);
}

}  // namespace
}  // namespace trisect
