#include "app/cli/options.h"

#include <gtest/gtest.h>

#include "app/base/error.h"

namespace trisect {
namespace {

TEST(ParseSize, TakesWidthAndHeight) {
  uint32_t width = 0;
  uint32_t height = 0;
  parse_size("--size", "1x4096", width, height);
  EXPECT_EQ(width, 1U);
  EXPECT_EQ(height, 4096U);
  for (const char* text : {"", "800", "800x", "x600", "0x5", "5x0", "800x600x", "8e2x6", "-8x6",
                           "99999x1", "800 x600", "99999999999x1"}) {
    EXPECT_THROW(parse_size("--size", text, width, height), UsageError) << text;
  }
}

TEST(ParseTriple, TakesThreeNumbers) {
  EXPECT_EQ(parse_triple("--eye", "1,-2.5,3e2"), glm::dvec3(1.0, -2.5, 300.0));
  for (const char* text :
       {"", "1,2", "1,2,3,4", "1,2,", "a,b,c", "1 2 3", "nan,0,0", "1,inf,0", "1e13,0,0"}) {
    EXPECT_THROW(parse_triple("--eye", text), UsageError) << text;
  }
}

TEST(ParseTriple, NamesTheOption) {
  try {
    parse_triple("--up", "1,2");
    FAIL() << "no error";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "--up: '1,2' is not three numbers such as 1,2.5,-3 of at most 1e+12.");
  }
}

}  // namespace
}  // namespace trisect
