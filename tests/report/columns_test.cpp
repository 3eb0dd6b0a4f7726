#include "app/report/columns.h"

#include <gtest/gtest.h>

#include <string>

namespace trisect::report {
namespace {

TEST(Cell, HasNumbersByTheFormatAndTextsAsTheyAre) {
  EXPECT_EQ(cell_of({"", "{:.1e}"}, 0.25), "2.5e-01");
  EXPECT_EQ(cell_of({"", "{}"}, 25U), "25");
  EXPECT_EQ(cell_of({"", "{:.1e}"}, "undecided"), "undecided");
  EXPECT_EQ(cell_of({"", "\"{}\""}, "a, b"), "\"a, b\"");
}

TEST(Cell, IsEmptyWithoutAValue) {
  EXPECT_EQ(cell_of({"", "{:.1e}"}, Value()), "");
  EXPECT_EQ(cell_of({"", "\"{}\""}, Value()), "\"\"");
}

TEST(Cell, FillsItsWidth) {
  EXPECT_EQ(cell_of({"", "{:.1f}", 5}, 0.25), "  0.2");
  EXPECT_EQ(cell_of({"", "{}", -5}, "ab"), "ab   ");
  EXPECT_EQ(cell_of({"", "{}", 2}, "long"), "long");
}

TEST(SetValue, MakesObjectsOnTheWay) {
  nlohmann::ordered_json object;
  set_value(object, "ms.median", 2.5);
  set_value(object, "ms.max", 3U);
  set_value(object, "none", Value());
  set_value(object, "a", "b");
  EXPECT_EQ(object.dump(), R"({"ms":{"median":2.5,"max":3},"a":"b"})");
}

}  // namespace
}  // namespace trisect::report
