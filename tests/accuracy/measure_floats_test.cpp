// The arithmetic of the device of this machine.
#include <gtest/gtest.h>

#include "app/accuracy/float_operations.h"
#include "tests/support/gpu.h"

namespace trisect {
namespace {

class MeasureFloats : public test::GpuTest {};

// What every device must keep: Vulkan's promises, and what the kernels rely on beyond them.
TEST_F(MeasureFloats, FindsWhatIsPromisedAndReliedOn) {
  const FloatReport report = measure_floats(test::validated_device());
  // Rounding of the double-precision reference, in ulp.
  constexpr double tiny = 1e-8;
  for (const LargestError& largest : {report.add, report.subtract, report.multiply}) {
    EXPECT_GT(largest.items, 2000U);
    EXPECT_LE(largest.ulp, 0.5 + tiny);
  }
  EXPECT_LE(report.divide.ulp, 2.5);
  EXPECT_LE(report.inversesqrt.ulp, 2.0);
  EXPECT_EQ(report.nearest_even.yes, report.nearest_even.of);
  EXPECT_EQ(report.precise_contracted.yes, 0U);
  EXPECT_GT(report.precise_contracted.of, 1000U);
  EXPECT_EQ(report.division_repeats.yes, report.division_repeats.of);
  EXPECT_EQ(report.nan_tests.yes, report.nan_tests.of);
  EXPECT_EQ(report.bits.yes, report.bits.of);
  EXPECT_EQ(report.denormal_broadcast.has_value(), test::validated_device().subgroup_size() != 0);
  // Drivers for the CPU use its own division and square root.
  if (test::validated_device().report().type == "cpu") {
    EXPECT_LE(report.divide.ulp, 0.5 + tiny);
    EXPECT_LE(report.sqrt.ulp, 0.5 + tiny);
  }
}

}  // namespace
}  // namespace trisect
