#include "app/cli/statistics.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trisect {
namespace {

TEST(SpreadOf, IsMinimumMedianMaximum) {
  const Spread odd = spread_of({3.0, 1.0, 2.0});
  EXPECT_EQ(odd.min, 1.0);
  EXPECT_EQ(odd.median, 2.0);
  EXPECT_EQ(odd.max, 3.0);
  EXPECT_EQ(spread_of({4.0, 1.0}).median, 2.5);
  EXPECT_EQ(spread_of({7.0}).median, 7.0);
}

TEST(ToJson, HasEveryKeyOfTheContract) {
  RenderOptions options;
  options.model = "a \"b\"\xff.obj";
  options.runs = 3;
  RenderStatistics statistics;
  statistics.source.device = "cpu";
  statistics.patches = 12;
  statistics.hits = 34;
  statistics.frames = {{3.0, 4.0}, {1.0, 2.0}, {2.0, 9.0}};
  const auto json = nlohmann::ordered_json::parse(to_json(options, statistics));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{
                      "program",     "version",      "commit",  "device",  "driver",   "backend",
                      "model",       "model_sha256", "patches", "width",   "height",   "surface",
                      "shell",       "solver",       "accel",   "rank",    "alpha",    "hits",
                      "scene_bytes", "camera",       "light",   "shading", "color",    "background",
                      "crease",      "weld",         "repair",  "shadows", "spp",      "runs",
                      "gpu_ms",      "wall_ms",      "load_ms", "bake_ms", "upload_ms"}));
  EXPECT_EQ(json["program"], "trisect");
  EXPECT_EQ(json["version"], TRISECT_VERSION);
  EXPECT_EQ(json["camera"]["fov"], 45.0);
  EXPECT_TRUE(json["crease"].is_null());
  EXPECT_EQ(json["patches"], 12);
  EXPECT_EQ(json["hits"], 34);
  EXPECT_EQ(json["surface"], "phong");
  EXPECT_EQ(json["shell"], "normal");
  EXPECT_EQ(json["solver"], "robust");
  EXPECT_EQ(json["accel"], "list");
  EXPECT_EQ(json["gpu_ms"]["min"], 1.0);
  EXPECT_EQ(json["gpu_ms"]["median"], 2.0);
  EXPECT_EQ(json["gpu_ms"]["max"], 3.0);
  EXPECT_EQ(json["wall_ms"]["median"], 4.0);
}

}  // namespace
}  // namespace trisect
