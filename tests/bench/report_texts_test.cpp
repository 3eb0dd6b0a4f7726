// The exact text of the reports of `trisect bench`, from fixed measurements.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/base/interval.h"
#include "app/bench/ablation_report.h"
#include "app/bench/pareto_report.h"
#include "app/bench/shape_report.h"
#include "app/bench/speed_report.h"
#include "app/bench/stability_report.h"
#include "app/bench/stress_table.h"
#include "app/report/document.h"
#include "tests/support/temporary_folder.h"

namespace trisect::bench {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The same JSON with other white space: keys, their order and digits stay.
std::string compact(const std::string& json) {
  return nlohmann::ordered_json::parse(json).dump();
}

std::string markdown(const report::Table& table) {
  return markdown_of(std::vector<report::Block>{table});
}

Measurement robust() {
  Measurement one;
  one.family = "robust, tiles";
  one.ms = {1.2344, 2.3456, 13.4567};
  one.errors.undecidable = 3;
  one.errors.wrong = 1;
  one.errors.missed = 2;
  one.errors.nans = 4;
  one.errors.off = {1.2345e-8, 2.3456e-7, 0.0};
  one.errors.depth_ulp = {0.51234, 1.98765, 12.3456};
  one.errors.normal_degrees = {0.001234, 0.0123456, 0.123456};
  one.errors.rms = 3.45678e-8;
  one.errors.outline.mean = 0.012345;
  one.errors.outline.max = 1.41421;
  one.errors.color_rmse = 0.0123456;
  one.errors.psnr = 86.2987;
  one.bytes = 123456;
  one.work = {98765, 4321, 7654321};
  return one;
}

// What counts no work, and gets all colours right.
Measurement thesis() {
  Measurement one;
  one.family = "thesis, height shell";
  one.number = "Rank 10";
  one.ms = {20.0, 25.0, 30.0};
  one.errors.rms = 0.25;
  one.errors.off.max = 1.0;
  one.errors.psnr = kInfinity;
  one.bytes = 1023;
  one.dominated_by = 0;
  return one;
}

Scene pareto() {
  Scene scene;
  scene.model = "teapot";
  scene.patches = 1234;
  scene.measurements = {robust(), thesis()};
  return scene;
}

TEST(ParetoReport, IsExactInCsv) {
  EXPECT_EQ(
      csv_of({pareto()}),
      R"(model,surface,patches,family,number,ms_median,ms_min,ms_max,rms,off_p50,off_p99,off_max,ulp_p50,ulp_p99,ulp_max,normal_p50,normal_p99,normal_max,wrong,missed,undecidable,nans,outline_mean,outline_max,color_rmse,psnr,evaluations,candidates,bytes_read,bytes,dominated_by
teapot,phong,1234,"robust, tiles","",2.346,1.234,13.457,3.4568e-08,1.2345e-08,2.3456e-07,0.0000e+00,0.512,1.99,12.3,1.234e-03,1.235e-02,1.235e-01,1,2,3,4,0.0123,1.414,0.012346,86.3,98765,4321,7654321,123456,""
teapot,phong,1234,"thesis, height shell","Rank 10",25.000,20.000,30.000,2.5000e-01,0.0000e+00,0.0000e+00,1.0000e+00,0,0,0,0.000e+00,0.000e+00,0.000e+00,0,0,0,0,0.0000,0.000,0,inf,0,0,0,1023,"robust, tiles"
)");
}

TEST(ParetoReport, IsExactInJson) {
  EXPECT_EQ(json_of({pareto()}).dump(),
            compact(R"([{"model":"teapot", "surface":"phong", "patches":1234,
    "measurements":[{"family":"robust, tiles", "number":"", "ms":{"min":1.2344,
    "median":2.3456, "max":13.4567}, "rms":3.45678e-08, "off_surface":{"p50":1.2345e-08,
    "p99":2.3456e-07, "max":0.0}, "depth_ulp":{"p50":0.51234, "p99":1.98765, "max":12.3456},
    "normal_degrees":{"p50":0.001234, "p99":0.0123456, "max":0.123456}, "wrong_hits":1,
    "missed":2, "undecidable":3, "nans":4, "outline":{"mean":0.012345, "max":1.41421},
    "color_rmse":0.0123456, "psnr":86.2987, "evaluations":98765, "candidates":4321,
    "bytes_read":7654321, "bytes":123456, "on_front":true}, {"family":"thesis, height shell",
    "number":"Rank 10", "ms":{"min":20.0, "median":25.0, "max":30.0}, "rms":0.25,
    "off_surface":{"p50":0.0, "p99":0.0, "max":1.0}, "depth_ulp":{"p50":0.0, "p99":0.0,
    "max":0.0}, "normal_degrees":{"p50":0.0, "p99":0.0, "max":0.0}, "wrong_hits":0,
    "missed":0, "undecidable":0, "nans":0, "outline":{"mean":0.0, "max":0.0},
    "color_rmse":0.0, "evaluations":0, "candidates":0, "bytes_read":0, "bytes":1023,
    "on_front":false, "dominated_by":"robust, tiles"}]}])"));
}

TEST(ParetoReport, IsExactAsTable) {
  EXPECT_EQ(
      markdown(table_of(pareto())),
      R"(| contender | ms | least | most | error | wrong | missed | off p50 | off p99 | off max | ulp p99 | normal p99 | outline | RMSE | PSNR | evaluations | MB read | KB | front |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
| robust, tiles | 2.3 | 1.2 | 13.5 | 3.5e-08 | 1 | 2 | 1.2e-08 | 2.3e-07 | 0.0e+00 | 2 | 0.012 | 0.01 | 0.012 | 86 | 98765 | 7 | 120 | yes |
| thesis, height shell, Rank 10 | 25.0 | 20.0 | 30.0 | 2.5e-01 | 0 | 0 | 0.0e+00 | 0.0e+00 | 1.0e+00 | 0 | 0 | 0.00 | 0 | inf |  |  | 0 |  |
)");
}

// A wrong pixel is on an axis of its own, and does not hide how near the others are.
TEST(ParetoReport, DrawsNinetyNineOfAHundredHitsTheLargestErrorAndWrongPixels) {
  const std::string script = plot_script(pareto(), "svg", "a.svg");
  const std::string robust_point = "2.3456e-07 1e-09 2.3456 3\n";
  EXPECT_NE(script.find("$family0 << EOD\n" + robust_point), std::string::npos) << script;
  EXPECT_NE(script.find("$family1 << EOD\n1e-09 1 25 0.5\n"), std::string::npos) << script;
  // Each panel has its own front: the thesis has no wrong pixel here.
  EXPECT_NE(script.find("$near << EOD\n2.3456e-07 2.3456\n1e-09 25\nEOD\n"), std::string::npos)
      << script;
  EXPECT_NE(script.find("$right << EOD\n3 2.3456\n0.5 25\nEOD\n"), std::string::npos) << script;
}

// It would be the nearest of all.
TEST(ParetoReport, DrawsNoDistanceOfWhatHitsNothing) {
  Scene scene = pareto();
  scene.measurements[1].errors.off = {};
  scene.measurements[1].errors.missed = 100;
  const std::string script = plot_script(scene, "svg", "a.svg");
  EXPECT_NE(script.find("nan nan 25 100\n"), std::string::npos) << script;
  EXPECT_NE(script.find("$near << EOD\n2.3456e-07 2.3456\nEOD\n"), std::string::npos) << script;
}

TEST(ParetoReport, SumsUpAllModelsWithASurfaceInTimesOfTheRobustSolver) {
  Scene torus = pareto();
  torus.model = "torus";
  torus.measurements[0].ms.median = 5.0;
  Scene sphere = pareto();
  sphere.model = "sphere-20";
  sphere.surface = SURFACE_SPHERE;
  const std::string script = summary_script({pareto(), torus, sphere}, SURFACE_PHONG, "svg", "a");
  EXPECT_NE(script.find("'phong: teapot, torus'"), std::string::npos) << script;
  // An empty line ends a scene's curve.
  const std::string robust_point = "2.3456e-07 1e-09 1 3\n";
  EXPECT_NE(script.find("$family0 << EOD\n" + robust_point + "\n" + robust_point + "\nEOD\n"),
            std::string::npos)
      << script;
  EXPECT_NE(script.find("1e-09 1 5 0.5\n"), std::string::npos) << script;
}

TEST(ParetoReport, DrawsNoTwoContendersInOneColour) {
  Scene scene = pareto();
  for (int k = 0; k < 12; ++k) {
    scene.measurements.push_back(thesis());
    scene.measurements.back().family = "contender " + std::to_string(k);
  }
  const std::string script = plot_script(scene, "svg", "a.svg");
  std::multiset<std::string> colours;
  const std::regex colour("hsv2rgb[^ ]* 1, [^ ]*");
  for (std::sregex_iterator it(script.begin(), script.end(), colour), end; it != end; ++it) {
    colours.insert(it->str());
  }
  // Each once in both panels.
  EXPECT_EQ(colours.size(), 28U);
  for (const std::string& one : colours) EXPECT_EQ(colours.count(one), 2U) << one;
}

ShapeRow shape_row(const std::string& model, std::size_t triangles, uint surface, double rms,
                   double ms, std::size_t bytes) {
  ShapeRow row;
  row.model = model;
  row.triangles = triangles;
  row.choice = {surface, 0.65, SHELL_NORMAL};
  row.accel = Accel::tiles;
  row.off_surface = 2e-3;
  row.samples.rms = rms;
  row.samples.distance = {0.5 * rms, 2.0 * rms, 2.5 * rms};
  row.samples.shading_degrees = {0.25, 1.5, 3.0};
  row.samples.face_degrees = {2.0, 12.0, 20.0};
  row.to_shape = {3.0 * rms, 3.1 * rms};
  row.to_model = {4.0 * rms, 4.1 * rms};
  row.wrong = 12;
  row.outline = {0.125, 3.0};
  row.color_rmse = 1.5;
  row.similarity = 0.987654;
  row.relative = 1.3e-3;
  row.ms = {0.5 * ms, ms, 2.0 * ms};
  row.bytes = bytes;
  return row;
}

Shape shape() {
  Shape result;
  result.reference = "fine";
  result.triangles = 1000000;
  result.radius = 1.5;
  result.rows = {shape_row("a-20", 20, SURFACE_FLAT, 0.1, 2.0, 2048),
                 shape_row("a-20", 20, SURFACE_PHONG, 0.01, 4.0, 4096),
                 shape_row("a-20", 20, SURFACE_SPHERE, 0.02, 8.0, 8192),
                 shape_row("a-80", 80, SURFACE_FLAT, 0.009, 3.0, 16384),
                 shape_row("a-80", 80, SURFACE_PHONG, 0.001, 6.0, 8192),
                 shape_row("b-90", 90, SURFACE_FLAT, 0.003, 3.0, 1024),
                 shape_row("b-90", 90, SURFACE_SPHERE, 0.003, 3.0, 1024)};
  result.frames = {{"trisect", {1.0, 2.0, 3.0}, 5000}};
  return result;
}

TEST(ShapeReport, SaysHowManyFlatTrianglesAreAsNear) {
  const std::vector<std::string> findings = findings_of(shape());
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_EQ(findings[0],
            "a-20, 20 triangles: the nearest curved surface is phong, alpha 0.65, 1.0e-02 off "
            "(RMS); 80 flat triangles are as near (9.0e-03 off). It takes 1.3 times their time "
            "and 0.25 times their memory.");
  EXPECT_EQ(
      findings[1],
      "a-80, 80 triangles: the nearest curved surface is phong, alpha 0.65, less than "
      "2.0e-03 off (RMS); 90 flat triangles are the most measured, and not as near (3.0e-03 off). "
      "It takes "
      "2 times their time and 8 times their memory.");
  EXPECT_EQ(findings[2],
            "b-90, 90 triangles: the nearest curved surface is sphere, 3.0e-03 off (RMS), no "
            "nearer than the flat triangles, 3.0e-03 off.");
}

TEST(ShapeReport, IsExactInCsv) {
  Shape one = shape();
  one.rows.resize(1);
  EXPECT_EQ(
      csv_of(one),
      R"(model,triangles,surface,off_surface,rms,p50,p99,to_shape_found,to_shape_bound,to_model_found,to_model_bound,shading_p50,shading_p99,face_p50,face_p99,wrong,outline_mean,outline_max,color_rmse,ssim,relmse,accel,ms_min,ms_median,ms_max,bytes
a-20,20,"flat",2.0000e-03,1.0000e-01,5.0000e-02,2.0000e-01,3.0000e-01,3.1000e-01,4.0000e-01,4.1000e-01,2.500e-01,1.500e+00,2.000e+00,1.200e+01,12,0.1250,3.000,1.5,0.987654,1.3000e-03,tiles,1.000,2.000,4.000,2048
)");
}

TEST(ShapeReport, IsExactAsTables) {
  Shape one = shape();
  one.rows.erase(one.rows.begin());
  one.rows.resize(1);
  EXPECT_EQ(
      markdown(table_of(one)),
      R"(| model | triangles | surface | measured to | RMS | p99 | largest | at most | back: largest | at most | shading normal p99 | normal p99 |
|---|---|---|---|---|---|---|---|---|---|---|---|
| a-20 | 20 | phong, alpha 0.65 | 2e-03 | 1.0e-02 | 2.0e-02 | 3.00e-02 | 3.10e-02 | 4.00e-02 | 4.10e-02 | 1.5 | 12 |
)");
  EXPECT_EQ(
      markdown(pictures_table_of(one)),
      R"(| model | surface | wrong pixels | outline | outline, most | RMSE | relMSE | SSIM | accel | ms | KB |
|---|---|---|---|---|---|---|---|---|---|---|
| a-20 | phong, alpha 0.65 | 12 | 0.12 | 3.0 | 1.5 | 1.3e-03 | 0.9877 | tiles | 4.0 | 4 |
)");
  EXPECT_EQ(markdown(frames_table_of(one)), R"(| drawn by | ms | KB |
|---|---|---|
| trisect | 2.0 | 4 |
)");
}

TEST(ShapeReport, DrawsEachSurfaceOverItsTriangles) {
  const std::string script = plot_script(shape(), "svg", "a.svg");
  EXPECT_NE(script.find("$surface0 << EOD\n20 2 0.1 0.3"), std::string::npos) << script;
  EXPECT_NE(script.find("$surface2 << EOD\n20 8 0.02 0.06\n90 3 0.003 "), std::string::npos)
      << script;
}

Ablation ablation() {
  Ablation result;
  result.model = "sphere-80";
  result.surface = SURFACE_SPHERE;
  result.patches = 80;
  result.pixels = 1000;
  result.steps = {{"the thesis", 0, thesis()}, {"the robust solver", 0, robust()}};
  // No pixel was decided.
  result.steps[0].measurement.errors.rms = kNan;
  return result;
}

TEST(AblationReport, IsExactInJson) {
  EXPECT_EQ(
      json_of({ablation()}).dump(),
      compact(
          R"([{"model":"sphere-80", "surface":"sphere", "patches":80, "steps":[{"change":"the thesis",
    "from":0, "ms":{"min":20.0, "median":25.0, "max":30.0}, "times_as_fast":1.0, "rms":null,
    "wrong_hits":0, "missed":0, "evaluations":0, "candidates":0, "bytes_read":0},
    {"change":"the robust solver", "from":0, "ms":{"min":1.2344, "median":2.3456,
    "max":13.4567}, "times_as_fast":10.65825375170532, "rms":3.45678e-08, "wrong_hits":1,
    "missed":2, "evaluations":98765, "candidates":4321, "bytes_read":7654321}]}])"));
}

TEST(AblationReport, IsExactAsTable) {
  EXPECT_EQ(
      markdown(table_of(ablation())),
      R"(|  | change | from | ms | times as fast | error | wrong or missed | evaluations a pixel | candidates a pixel | bytes a pixel |
|---|---|---|---|---|---|---|---|---|---|
| 1 | the thesis |  | 25.0 |  | nan | 0 | 0.0 | 0.00 | 0 |
| 2 | the robust solver | 1 | 2.3 | 10.66 | 3.5e-08 | 3 | 98.8 | 4.32 | 7654 |
)");
}

std::vector<StabilityAxis> stability() {
  StabilityAxis axis;
  axis.name = "scale";
  axis.what = "the scene's scale";
  axis.curves = {{"robust", {{0.001, 1.23456e-8, 98, 0, 1, 0}, {1000.0, kNan, 0, 0, 0, 2}}},
                 {"bisect", {{0.001, 0.0456789, 99, 3, 4, 5}, {1000.0, 1.0, 100, 0, 100, 0}}}};
  return {axis};
}

TEST(StabilityReport, IsExactInCsv) {
  EXPECT_EQ(csv_of(stability()), R"(axis,solver,value,error,decided,wrong,missed,nans
scale,"robust",0.001,1.2346e-08,98,0,1,0
scale,"robust",1000,nan,0,0,0,2
scale,"bisect",0.001,4.5679e-02,99,3,4,5
scale,"bisect",1000,1.0000e+00,100,0,100,0
)");
}

TEST(StabilityReport, IsExactInJson) {
  EXPECT_EQ(
      json_of(stability()).dump(),
      compact(
          R"([{"axis":"scale", "solver":"robust", "points":[{"value":0.001, "decided":98, "wrong":0,
    "missed":1, "nans":0, "error":1.23456e-08}, {"value":1000.0, "decided":0, "wrong":0,
    "missed":0, "nans":2}]}, {"axis":"scale", "solver":"bisect", "points":[{"value":0.001,
    "decided":99, "wrong":3, "missed":4, "nans":5, "error":0.0456789}, {"value":1000.0,
    "decided":100, "wrong":0, "missed":100, "nans":0, "error":1.0}]}])"));
}

TEST(StabilityReport, IsExactAsTable) {
  EXPECT_EQ(
      markdown(table_of(stability()[0])),
      R"(| the scene's scale | robust: error | wrong | missed | NaNs | bisect: error | wrong | missed | NaNs | rays decided |
|---|---|---|---|---|---|---|---|---|---|
| 0.001 | 1.2e-08 | 0 | 1 | 0 | 4.6e-02 | 3 | 4 | 5 | 98 |
| 1000 | undecided | 0 | 0 | 2 | 1.0e+00 | 0 | 100 | 0 | 0 |
)");
}

std::vector<SpeedRow> speed() {
  SpeedRow image;
  image.model = "models/torus.obj";
  image.patches = 256;
  image.contender = "image only";
  image.ms = {0.1, 0.125, 0.2};
  image.cpu_ms = {0.1875, 0.25, 0.375};
  image.thesis_ms = 25.0;
  image.floor_ms = 0.125;
  SpeedRow embree = image;
  embree.contender = "Embree, single rays";
  embree.ms = {2.0, 3.14159, 40.0};
  embree.cpu_ms = {3.75, 6.125, 70.5};
  embree.checked_pixels = 300;
  embree.wrong_pixels = 7;
  embree.bytes = 5000;
  embree.build_ms = 12.75;
  embree.flat_triangles = 4096;
  embree.flat_error = 9.5e-7;
  return {image, embree};
}

TEST(SpeedReport, IsExactInJson) {
  EXPECT_EQ(
      speed_columns().json(speed()[0]).dump(),
      compact(
          R"({"model":"models/torus.obj", "surface":"phong", "patches":256, "contender":"image only",
    "ms":{"min":0.1, "median":0.125, "max":0.2},
    "cpu_ms":{"min":0.1875, "median":0.25, "max":0.375}, "bytes":0})"));
  EXPECT_EQ(speed_columns().json(speed()[1]).dump(),
            compact(R"({"model":"models/torus.obj", "surface":"phong", "patches":256,
    "contender":"Embree, single rays", "ms":{"min":2.0, "median":3.14159, "max":40.0},
    "cpu_ms":{"min":3.75, "median":6.125, "max":70.5}, "checked_pixels":300, "wrong_pixels":7, "bytes":5000, "build_ms":12.75,
    "flat_triangles":4096, "flat_error":9.5e-07})"));
}

TEST(SpeedReport, IsExactAsTable) {
  EXPECT_EQ(
      speed_columns().markdown_header() + speed_columns().markdown_row(speed()[0]) +
          speed_columns().markdown_row(speed()[1]),
      R"(| model | surface | contender | ms | least | most | CPU ms | of the thesis | of the image | wrong | of | KB | build ms |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
| torus | phong | image only | 0.1 | 0.1 | 0.2 | 0.2 | 0.005 | 1.0 |  |  | 0 |  |
| torus | phong | Embree, single rays | 3.1 | 2.0 | 40.0 | 6.1 | 0.126 | 25.1 | 7 | 300 | 4 | 13 |
)");
}

constexpr const char* kHardcases = R"({"device": "a device", "driver": "a driver", "rows": [
  {"case": "needle", "what": "a needle", "kind": "shape", "surface": "phong", "shell": "normal",
   "solver": "robust", "rank": 10, "rays": 120, "undecidable": 1, "wrong": 0, "missed": 2,
   "depth_error_ulp_p50": 0.12345, "depth_error_ulp_p99": 1234.5, "depth_error_ulp_max": 0.0,
   "nans": 3, "evaluations_per_ray": 3.256, "verdict": "pass", "note": ""},
  {"case": "files", "what": "files", "kind": "data", "surface": "phong", "shell": "normal",
   "solver": "robust", "rank": 10, "rays": 5, "undecidable": 0, "wrong": 0, "missed": 0,
   "depth_error_ulp_p50": 0, "depth_error_ulp_p99": 0, "depth_error_ulp_max": 0,
   "nans": 0, "evaluations_per_ray": 0, "verdict": "FAIL", "note": "one was read"}]})";

TEST(StressTable, IsExact) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "hardcases.json";
  std::ofstream(path) << kHardcases;
  const StressTable result = read_stress_table(path);
  EXPECT_EQ(result.device, "a device, a driver");
  EXPECT_EQ(
      markdown(result.table),
      R"(| case | surface | shell | solver | rays | undecidable | wrong | missed | p50 ulp | p99 ulp | max ulp | NaNs | evaluations a ray | verdict |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
| needle | phong | normal | robust | 120 | 1 | 0 | 2 | 0.123 | 1.23e+03 | 0 | 3 | 3.26 | pass |
| files | phong | normal | robust | 5 | 0 | 0 | 0 | 0 | 0 | 0 | 0 | 0 | FAIL (one was read) |
)");
}

TEST(StressTable, WantsEveryFigure) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "hardcases.json";
  for (const char* key : {"case", "rays", "depth_error_ulp_p99", "verdict", "note"}) {
    nlohmann::json json = nlohmann::json::parse(kHardcases);
    json["rows"][1].erase(key);
    std::ofstream(path) << json;
    EXPECT_THROW(read_stress_table(path), InputError) << key;
  }
}

}  // namespace
}  // namespace trisect::bench
