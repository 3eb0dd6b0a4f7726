#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "app/atomic_file.h"
#include "app/commands.h"
#include "app/error.h"
#include "app/image_file.h"
#include "app/interrupt.h"
#include "app/mesh_builder.h"
#include "app/statistics.h"
#include "app/trace_settings.h"
#include "app/vulkan_tracer.h"

namespace trisect {
namespace {

// Runs a step and adds its milliseconds to `ms`.
template <typename Step>
auto timed(double& ms, Step&& step) {
  const auto start = std::chrono::steady_clock::now();
  auto result = step();
  ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  stop_if_interrupted();
  return result;
}

TraceSettings settings_for(const RenderOptions& options, const Mesh& mesh,
                           const BakedScene& scene) {
  TraceSettings settings;
  settings.width = options.width;
  settings.height = options.height;
  settings.rank = options.rank;
  const double aspect = static_cast<double>(options.width) / static_cast<double>(options.height);
  settings.camera = framing_camera(mesh.positions, scene.origin, options.fov, options.up, aspect);
  if (options.eye) settings.camera.eye = *options.eye;
  if (options.target) settings.camera.target = *options.target;
  return settings;
}

// Throws UsageError if two of the files are the same, or if an output is the model.
void expect_distinct(const RenderOptions& options) {
  const auto expect = [](const std::string& a, const std::string& b) {
    std::error_code error;
    const auto resolved = [&](const std::string& path) {
      return std::filesystem::weakly_canonical(path, error);
    };
    if (resolved(a) == resolved(b)) {
      throw UsageError(fmt::format("{} and {} are the same file.", a, b));
    }
  };
  expect(options.output, options.model);
  if (options.stats.empty()) return;
  expect(options.stats, options.model);
  expect(options.stats, options.output);
}

// Renders with validation on or off, and returns the layer's messages, those of the clean-up among
// them.
std::vector<std::string> trace(const RenderOptions& options, const BakedScene& scene,
                               const TraceParams& params, bool aovs, Frame& frame,
                               RenderStatistics& statistics) {
  const gpu::Instance instance(options.validation);
  {
    const gpu::Device device(instance, options.device);
    statistics.device = device.report().name;
    statistics.driver = device.report().driver;
    VulkanTracer tracer(device, scene, options.width, options.height, aovs);
    statistics.upload_ms = tracer.upload_ms();
    tracer.render(params, frame, stop_if_interrupted);
    for (uint32_t run = 0; run < options.runs; ++run) {
      statistics.frames.push_back(tracer.render(params, frame, stop_if_interrupted));
    }
  }
  return instance.log().messages();
}

}  // namespace

int render(const RenderOptions& options) {
  const ImageFormat format = image_format(options.output);
  expect_distinct(options);
  RenderStatistics statistics;
  const BuiltMesh built = timed(statistics.load_ms, [&] {
    return build_mesh(read_obj(options.model), options.model, options.crease);
  });
  fmt::print("{}: {}\n", options.model, describe(built.report));
  const BakedScene scene = timed(statistics.bake_ms, [&] {
    return bake(built.mesh, {options.surface, options.alpha});
  });
  const TraceParams params = make_params(scene, settings_for(options, built.mesh, scene));

  AtomicFile image(options.output);
  std::optional<AtomicFile> stats;
  if (!options.stats.empty()) stats.emplace(options.stats);

  Frame frame;
  const std::vector<std::string> messages =
      trace(options, scene, params, format == ImageFormat::exr, frame, statistics);
  statistics.patches = scene.triangles.size();
  statistics.hits = frame.hits();

  if (format == ImageFormat::png) {
    write_png(frame, image);
  } else {
    write_exr(frame, image);
  }
  if (stats) stats->write(to_json(options, statistics));
  image.commit();
  if (stats) stats->commit();
  fmt::print("{}{}\n", to_text(options, statistics), options.output);

  for (const std::string& message : messages) fmt::print(stderr, "validation: {}\n", message);
  return messages.empty() ? exit_done : exit_internal;
}

}  // namespace trisect
