// The exact text of the report of `trisect bench terminator`, from fixed measurements.
#include "app/bench/terminator_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/report/document.h"

namespace trisect::bench {
namespace {

// One model in two lights.
std::vector<TerminatorRow> terminator() {
  return {{"a-20", 20, 60.0, "curved", 100, 80, 0, 0, 0.0, {3.0, 4.0, 5.0}},
          {"a-20", 20, 60.0, "flat", 100, 80, 8, 1, 0.3, {1.0, 1.0, 1.0}},
          {"a-20", 20, 60.0, "Cycles", 100, 80, 4, 3, 0.2, {1.0, 2.0, 4.0}},
          {"a-20", 20, 60.0, "no shadows", 100, 80, 0, 6, 0.2, {1.0, 1.0, 1.0}},
          {"a-20", 20, 90.0, "curved", 300, 20, 0, 0, 0.0, {1.0, 2.0, 3.0}},
          {"a-20", 20, 90.0, "flat", 300, 20, 12, 2, 0.1, {1.0, 1.0, 1.0}},
          {"a-20", 20, 90.0, "Cycles", 300, 20, 1, 3, 0.1, {1.0, 1.0, 1.0}},
          {"a-20", 20, 90.0, "no shadows", 300, 20, 0, 0, 0.2, {1.0, 1.0, 1.0}}};
}

TEST(TerminatorReport, SaysWhatPartIsInTheDark) {
  EXPECT_EQ(findings_of(terminator()),
            std::vector<std::string>{
                "a-20, 20 triangles, of 100 pixels that are lit: curved shadows leave 0 (0%) "
                "wrongly dark and 0 wrongly bright; flat ones 20 (20%) wrongly dark and 3 wrongly "
                "bright; of what renderers do about it, the best (Cycles) leaves 5 (5%) wrongly "
                "dark and 6 wrongly bright."});
}

TEST(TerminatorReport, NamesAllThatAreTheBest) {
  std::vector<TerminatorRow> rows = terminator();
  rows[3].shadows = rows[7].shadows = "other";
  rows[7].dark = 5;
  const std::string finding = findings_of(rows).front();
  EXPECT_NE(finding.find("the best (Cycles; other) leaves 5 (5%)"), std::string::npos) << finding;
}

TEST(TerminatorReport, SaysThatNothingIsLit) {
  std::vector<TerminatorRow> rows = terminator();
  for (TerminatorRow& row : rows) row.lit = row.dark = 0;
  EXPECT_EQ(findings_of(rows),
            std::vector<std::string>{"a-20, 20 triangles: nothing that is seen is lit."});
  rows.resize(1);
  rows[0].pixels = 0;
  EXPECT_EQ(
      report::markdown_of({summary_table_of(rows)}),
      R"(| model | triangles | shadows | lit | wrongly dark | % of lit | wrongly bright | % of shadow | RMSE | ms |
|---|---|---|---|---|---|---|---|---|---|
| a-20 | 20 | curved | 0 | 0 |  | 0 |  |  | 4.0 |
)");
}

// Names of files are a user's: gnuplot would run what stands between back-quotes.
TEST(TerminatorReport, TakesAnyNameInAPlot) {
  std::vector<TerminatorRow> rows = terminator();
  for (TerminatorRow& row : rows) row.model = "it's_`touch x`\nsystem";
  const std::string script = terminator_plot(rows, "svg", "a'.svg");
  EXPECT_NE(script.find("set output 'a''.svg'\n"), std::string::npos) << script;
  EXPECT_NE(script.find("title 'it''s_`touch x`?system, 20 triangles' noenhanced\n"),
            std::string::npos)
      << script;
}

TEST(TerminatorReport, AddsLightsUp) {
  std::vector<TerminatorRow> rows = over_lights(terminator());
  ASSERT_EQ(rows.size(), 4U);
  // The root of (100 0.3^2 + 300 0.1^2) / 400.
  EXPECT_NEAR(rows[1].rmse, std::sqrt(0.03), 1e-12);
  rows.resize(2);
  EXPECT_EQ(
      report::markdown_of({summary_table_of(rows)}),
      R"(| model | triangles | shadows | lit | wrongly dark | % of lit | wrongly bright | % of shadow | RMSE | ms |
|---|---|---|---|---|---|---|---|---|---|
| a-20 | 20 | curved | 100 | 0 | 0.00 | 0 | 0.00 | 0.0e+00 | 3.0 |
| a-20 | 20 | flat | 100 | 20 | 20.00 | 3 | 1.00 | 1.7e-01 | 1.0 |
)");
}

TEST(TerminatorReport, IsExactInCsv) {
  std::vector<TerminatorRow> rows = terminator();
  rows.resize(2);
  EXPECT_EQ(csv_of(rows),
            R"(model,triangles,light,shadows,pixels,lit,dark,bright,rmse,ms_min,ms_median,ms_max
a-20,20,60,"curved",100,80,0,0,0.0000e+00,3.000,4.000,5.000
a-20,20,60,"flat",100,80,8,1,3.0000e-01,1.000,1.000,1.000
)");
}

TEST(TerminatorReport, DrawsEachWayOverTheLights) {
  const std::string script = terminator_plot(terminator(), "svg", "a.svg");
  EXPECT_NE(script.find("$way1 << EOD\n60 10 0.3\n90 60 0.1\nEOD\n"), std::string::npos) << script;
}

}  // namespace
}  // namespace trisect::bench
