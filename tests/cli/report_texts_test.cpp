// The exact text of the tables of `trisect accuracy` and `trisect hardcases`, from fixed rows.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/cli/accuracy_report.h"
#include "app/cli/hardcases_report.h"

namespace trisect {
namespace {

// The same JSON with other white space: keys, their order and digits stay.
std::string compact(const std::string& json) {
  return nlohmann::ordered_json::parse(json).dump();
}

AccuracyRow accuracy() {
  AccuracyRow row;
  row.model = "models/teapot.obj";
  row.choice = {SURFACE_SPHERE, 0.65, SHELL_HEIGHT};
  row.solver = SOLVER_ROBUST;
  row.accuracy.pixels = 480000;
  row.accuracy.hits = 123456;
  row.accuracy.undecidable = 5;
  row.accuracy.wrong_hits = 1;
  row.accuracy.missed = 2;
  row.accuracy.wrong_patches = 3;
  row.accuracy.nans = 4;
  row.accuracy.off_surface = {1.2345e-8, 2.3456e-7, 1.5e-6};
  row.accuracy.depth_ulp = {0.51234, 1.98765, 12.3456};
  row.accuracy.normal_degrees = {0.001234, 0.0123456, 0.123456};
  row.accuracy.median_evaluations = 4.25;
  row.cpu_differs = 6;
  row.gpu_ms = 1234.56;
  row.verdict = "FAIL";
  return row;
}

AccuracyRow bisection() {
  AccuracyRow row;
  row.model = "cube.obj";
  row.solver = SOLVER_BISECT;
  return row;
}

TEST(AccuracyReport, IsExactInJson) {
  EXPECT_EQ(
      accuracy_columns().json(accuracy()).dump(),
      compact(
          R"({"model":"models/teapot.obj", "surface":"sphere", "shell":"height", "solver":"robust",
    "pixels":480000, "hits":123456, "undecidable":5, "wrong_hits":1, "missed":2,
    "wrong_patches":3, "nans":4, "off_surface":{"p50":1.2345e-08, "p99":2.3456e-07,
    "max":1.5e-06}, "depth_ulp":{"p50":0.51234, "p99":1.98765, "max":12.3456},
    "normal_degrees":{"p50":0.001234, "p99":0.0123456, "max":0.123456},
    "evals_per_candidate":4.25, "cpu_differs":6, "gpu_ms":1234.56, "verdict":"FAIL"})"));
}

TEST(AccuracyReport, IsExactAsTable) {
  EXPECT_EQ(
      accuracy_table_header() + accuracy_columns().markdown_row(accuracy()) +
          accuracy_columns().markdown_row(bisection()),
      R"(| model | surface | shell | solver | hit | undecidable | wrong hit | missed | wrong patch | off p50 | off p99 | off max | ulp p50 | ulp p99 | normal p99 | evals | cpu differs | ms | |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
| teapot | sphere | height | robust | 123456 | 5 | 1 | 2 | 3 | 1.2e-08 | 2.3e-07 | 1.5e-06 | 0.51 | 2 | 0.0123 | 4.2 | 6 | 1235 | FAIL |
| cube | phong | normal | bisect | 0 | 0 | 0 | 0 | 0 | 0.0e+00 | 0.0e+00 | 0.0e+00 | 0 | 0 | 0.0000 | 0.0 | 0 | 0 |  |
)");
}

StressRow needle() {
  StressRow row;
  row.name = "needle";
  row.what = "a patch as thin as a needle";
  row.rank = 12;
  row.outcome.rays = 120;
  row.outcome.undecidable = 1;
  row.outcome.wrong = 2;
  row.outcome.missed = 3;
  row.outcome.nans = 4;
  row.outcome.errors = {1e-9, 2e-8, 3.456e-4};
  row.outcome.evaluations = 1000.0;
  row.verdict = "FAIL";
  return row;
}

StressRow files() {
  StressRow row;
  row.name = "a-name-of-more-than-its-column";
  row.what = "files";
  row.kind = StressKind::data;
  row.surface = SURFACE_FLAT;
  row.shell = SHELL_HEIGHT;
  row.solver = SOLVER_BISECT;
  row.verdict = "ok";
  row.outcome.note = "none was read";
  return row;
}

TEST(HardcasesReport, IsExactInJson) {
  EXPECT_EQ(
      hardcases_columns().json(needle()).dump(),
      compact(
          R"({"case":"needle", "what":"a patch as thin as a needle", "kind":"shape", "surface":"phong",
    "shell":"normal", "solver":"robust", "rank":12, "rays":120, "undecidable":1,
    "most_undecidable":0.1, "wrong":2,
    "missed":3, "depth_error_ulp_p50":0.16777216, "depth_error_ulp_p99":2899.1029248,
    "depth_error_ulp_max":2899.1029248, "nans":4, "evaluations_per_ray":8.333333333333334,
    "verdict":"FAIL", "note":""})"));
  EXPECT_EQ(
      hardcases_columns().json(files()).dump(),
      compact(
          R"({"case":"a-name-of-more-than-its-column", "what":"files", "kind":"data", "surface":"flat",
    "shell":"height", "solver":"bisect", "rank":10, "rays":0, "undecidable":0,
    "most_undecidable":0.1, "wrong":0,
    "missed":0, "depth_error_ulp_p50":0.0, "depth_error_ulp_p99":0.0,
    "depth_error_ulp_max":0.0, "nans":0, "evaluations_per_ray":0.0, "verdict":"ok",
    "note":"none was read"})"));
}

TEST(HardcasesReport, IsExactAsText) {
  EXPECT_EQ(
      hardcases_columns().text_header() + hardcases_columns().text_row(needle()) +
          hardcases_columns().text_row(files()),
      R"(case                    surface shell   solver   rays undec.  wrong missed  p50 ulp  p99 ulp   max ulp  NaNs eval/ray  verdict
needle                  phong   normal  robust    120      1      2      3    0.168  2.9e+03   2.9e+03     4      8.3  FAIL
a-name-of-more-than-its-column flat    height  bisect      0      0      0      0        0        0         0     0      0.0  ok (none was read)
)");
}

}  // namespace
}  // namespace trisect
