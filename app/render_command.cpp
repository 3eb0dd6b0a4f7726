#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <optional>

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

}  // namespace

int render(const RenderOptions& options) {
  const ImageFormat format = image_format(options.output);
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

  const gpu::Instance instance(options.validation);
  const gpu::Device device(instance, options.device);
  statistics.device = device.report().name;
  statistics.driver = device.report().driver;
  Frame frame;
  {
    VulkanTracer tracer(device, scene, options.width, options.height, format == ImageFormat::exr);
    statistics.upload_ms = tracer.upload_ms();
    tracer.render(params, frame, stop_if_interrupted);
    for (uint32_t run = 0; run < options.runs; ++run) {
      statistics.frames.push_back(tracer.render(params, frame, stop_if_interrupted));
    }
  }
  statistics.patches = scene.triangles.size();
  statistics.hits = frame.hits();

  if (format == ImageFormat::png) {
    write_png(frame, image);
  } else {
    write_exr(frame, image);
  }
  image.commit();
  if (stats) {
    stats->write(to_json(options, statistics));
    stats->commit();
  }
  fmt::print("{}{}\n", to_text(options, statistics), options.output);

  const std::vector<std::string> messages = instance.log().messages();
  for (const std::string& message : messages) fmt::print(stderr, "validation: {}\n", message);
  return messages.empty() ? exit_done : exit_internal;
}

}  // namespace trisect
