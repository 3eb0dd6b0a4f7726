#include "app/cli/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/json_text.h"
#include "app/cli/provenance.h"
#include "app/dispatch/accel.h"

namespace trisect {
namespace {

Spread spread_over(const std::vector<FrameTime>& frames, double FrameTime::*time) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const FrameTime& frame : frames) values.push_back(frame.*time);
  return spread_of(std::move(values));
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values.front(), (values[(n - 1) / 2] + values[n / 2]) / 2.0, values.back()};
}

nlohmann::ordered_json json_of(const Spread& spread) {
  return {{"min", spread.min}, {"median", spread.median}, {"max", spread.max}};
}

WorkCounts work_of(const Frame& frame) {
  WorkCounts counts;
  counts.bytes_read = frame.bytes_read;
  counts.queued_rays = frame.queued_rays;
  for (const PixelAovs& pixel : frame.aovs) {
    counts.evaluations += pixel.evaluations;
    counts.candidates += pixel.candidates;
  }
  return counts;
}

std::string to_json(const RenderOptions& options, const RenderStatistics& statistics) {
  nlohmann::ordered_json json;
  json["program"] = "trisect";
  json["version"] = TRISECT_VERSION;
  json["commit"] = commit();
  json["device"] = statistics.source.device;
  json["driver"] = statistics.source.driver;
  json["backend"] = backend_name(options.backend);
  if (options.backend == Backend::opengl) json["gl_path"] = gl_path_name(options.gl_path);
  json["model"] = options.model;
  json["model_sha256"] = statistics.source.model_sha256;
  json["patches"] = statistics.patches;
  json["width"] = options.width;
  json["height"] = options.height;
  if (statistics.frame) json["frame"] = *statistics.frame;
  if (options.tile) {
    const ImagePart& tile = *options.tile;
    json["tile"] = {tile.x, tile.y, tile.width, tile.height};
  }
  json["surface"] = surface_name(options.surface);
  json["shell"] = shell_name(options.shell);
  json["solver"] = solver_name(options.solver);
  json["accel"] = accel_name(statistics.source.accel);
  json["rank"] = options.rank;
  json["alpha"] = options.alpha;
  json["hits"] = statistics.hits;
  json["scene_bytes"] = statistics.scene_bytes;
  if (statistics.counts) {
    json["evals_total"] = statistics.counts->evaluations;
    json["candidates_total"] = statistics.counts->candidates;
    if (statistics.counts->bytes_read > 0) json["bytes_read"] = statistics.counts->bytes_read;
    if (options.backend == Backend::vulkan) json["queued_rays"] = statistics.counts->queued_rays;
  }
  const TraceSettings& settings = statistics.source.settings;
  const auto triple = [](const glm::dvec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  json["camera"] = {{"eye", triple(settings.camera.eye)},
                    {"target", triple(settings.camera.target)},
                    {"up", triple(settings.camera.up)},
                    {"fov", settings.camera.fov}};
  json["light"] = triple(settings.light);
  json["shading"] = shading_name(settings.shading);
  json["color"] = options.color ? triple(*options.color) : nlohmann::ordered_json();
  json["background"] = background_text(settings.background, settings.background_color);
  json["crease"] = options.mesh.crease_degrees
                       ? nlohmann::ordered_json(*options.mesh.crease_degrees)
                       : nlohmann::ordered_json();
  json["weld"] = options.mesh.weld;
  json["repair"] = options.mesh.repair;
  json["shadows"] = options.shadows;
  json["spp"] = options.spp;
  json["runs"] = statistics.frames.size();
  json["gpu_ms"] = json_of(spread_over(statistics.frames, &FrameTime::gpu_ms));
  json["wall_ms"] = json_of(spread_over(statistics.frames, &FrameTime::wall_ms));
  json["load_ms"] = statistics.load_ms;
  json["bake_ms"] = statistics.bake_ms;
  if (statistics.bvh_ms) json["bvh_ms"] = *statistics.bvh_ms;
  json["upload_ms"] = statistics.upload_ms;
  return json_text(json);
}

std::string to_text(const RenderOptions& options, const RenderStatistics& statistics) {
  const Spread gpu = spread_over(statistics.frames, &FrameTime::gpu_ms);
  const Spread wall = spread_over(statistics.frames, &FrameTime::wall_ms);
  const std::string alpha =
      options.surface == SURFACE_PHONG ? fmt::format(" (alpha {:g})", options.alpha) : "";
  const std::string solver = options.surface == SURFACE_FLAT ? "met without a search"
                             : options.solver == SOLVER_BISECT
                                 ? fmt::format("bisect at Rank {}", options.rank)
                                 : "robust";
  const std::string counts =
      statistics.counts ? fmt::format("{} evaluations for {} candidates\n",
                                      statistics.counts->evaluations, statistics.counts->candidates)
                        : "";
  return fmt::format(
      "device {}, driver {}\n"
      "{} patches, surface {}{}, shell {}, solver {}, accel {}, {}x{}: {} pixels hit\n{}"
      "load {:.1f} ms, bake {:.1f} ms, upload {:.1f} ms, gpu {:.1f} ms, wall {:.1f} ms{}\n",
      statistics.source.device, statistics.source.driver, statistics.patches,
      surface_name(options.surface), alpha, shell_name(options.shell), solver,
      accel_name(statistics.source.accel), options.width, options.height, statistics.hits, counts,
      statistics.load_ms, statistics.bake_ms, statistics.upload_ms, gpu.median, wall.median,
      statistics.frames.size() > 1 ? fmt::format(" (medians of {} runs, gpu {:.1f} to {:.1f} ms)",
                                                 statistics.frames.size(), gpu.min, gpu.max)
      : options.runs               ? ""
                                   : " (the first frame; --runs N times warm ones)");
}

}  // namespace trisect
