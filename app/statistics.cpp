#include "app/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace trisect {
namespace {

Spread spread_over(const std::vector<FrameTime>& frames, double FrameTime::*time) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const FrameTime& frame : frames) values.push_back(frame.*time);
  return spread_of(std::move(values));
}

nlohmann::ordered_json json_of(const Spread& spread) {
  return {{"min", spread.min}, {"median", spread.median}, {"max", spread.max}};
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values.front(), (values[(n - 1) / 2] + values[n / 2]) / 2.0, values.back()};
}

std::string to_json(const RenderOptions& options, const RenderStatistics& statistics) {
  nlohmann::ordered_json json;
  json["program"] = "trisect";
  json["version"] = TRISECT_VERSION;
  json["device"] = statistics.device;
  json["driver"] = statistics.driver;
  json["model"] = options.model;
  json["patches"] = statistics.patches;
  json["width"] = options.width;
  json["height"] = options.height;
  json["surface"] = surface_name(options.surface);
  json["shell"] = "height";
  json["solver"] = "bisect";
  json["accel"] = "list";
  json["rank"] = options.rank;
  json["alpha"] = options.alpha;
  json["hits"] = statistics.hits;
  json["runs"] = options.runs;
  json["gpu_ms"] = json_of(spread_over(statistics.frames, &FrameTime::gpu_ms));
  json["wall_ms"] = json_of(spread_over(statistics.frames, &FrameTime::wall_ms));
  json["load_ms"] = statistics.load_ms;
  json["bake_ms"] = statistics.bake_ms;
  json["upload_ms"] = statistics.upload_ms;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string to_text(const RenderOptions& options, const RenderStatistics& statistics) {
  const Spread gpu = spread_over(statistics.frames, &FrameTime::gpu_ms);
  const Spread wall = spread_over(statistics.frames, &FrameTime::wall_ms);
  const std::string surface =
      options.surface == SURFACE_FLAT ? "flat, met without a march"
      : options.surface == SURFACE_PHONG
          ? fmt::format("phong (alpha {:g}), bisection at Rank {}", options.alpha, options.rank)
          : fmt::format("sphere, bisection at Rank {}", options.rank);
  return fmt::format(
      "device {}, driver {}\n"
      "{} patches, surface {}, {}x{}: {} pixels hit\n"
      "load {:.1f} ms, bake {:.1f} ms, upload {:.1f} ms, gpu {:.1f} ms, wall {:.1f} ms{}\n",
      statistics.device, statistics.driver, statistics.patches, surface, options.width,
      options.height, statistics.hits, statistics.load_ms, statistics.bake_ms, statistics.upload_ms,
      gpu.median, wall.median,
      options.runs > 1 ? fmt::format(" (medians of {} runs, gpu {:.1f} to {:.1f} ms)", options.runs,
                                     gpu.min, gpu.max)
                       : "");
}

}  // namespace trisect
