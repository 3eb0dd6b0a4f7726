#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "app/atomic_file.h"
#include "app/cage.h"
#include "app/commands.h"
#include "app/cpu_tracer.h"
#include "app/error.h"
#include "app/image_file.h"
#include "app/interrupt.h"
#include "app/mesh_builder.h"
#include "app/oracle_tracer.h"
#include "app/progress.h"
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
  settings.solver = options.solver;
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

WorkCounts count_work(const Frame& frame) {
  WorkCounts counts;
  for (const PixelAovs& pixel : frame.aovs) {
    counts.evaluations += pixel.evaluations;
    counts.candidates += pixel.candidates;
  }
  return counts;
}

// Renders with validation on or off, and returns the layer's messages, those of the clean-up among
// them.
std::vector<std::string> trace_on_vulkan(const RenderOptions& options, const BakedScene& scene,
                                         const TraceParams& params, const KernelChoice& choice,
                                         Frame& frame, RenderStatistics& statistics) {
  const gpu::Instance instance(options.validation);
  {
    const gpu::Device device(instance, options.device);
    statistics.device = device.report().name;
    statistics.driver = device.report().driver;
    VulkanTracer tracer(device, scene, options.width, options.height, choice);
    statistics.upload_ms = tracer.upload_ms();
    tracer.render(params, frame, stop_if_interrupted);
    for (uint32_t run = 0; run < options.runs; ++run) {
      statistics.frames.push_back(tracer.render(params, frame, stop_if_interrupted));
    }
  }
  return instance.log().messages();
}

// The back ends that run on the host: `frame_once` renders one frame, told how far it is.
template <typename FrameOnce>
void trace_on_host(const RenderOptions& options, const std::string& driver,
                   RenderStatistics& statistics, FrameOnce&& frame_once) {
  statistics.device = fmt::format("CPU, {} threads", std::thread::hardware_concurrency());
  statistics.driver = driver;
  for (uint32_t run = 0; run < options.runs; ++run) {
    Progress progress("rendering", options.height);
    FrameTime time;
    timed(time.wall_ms, [&] {
      frame_once([&](uint32_t rows) { progress.show(rows); });
      return 0;
    });
    statistics.frames.push_back(time);
  }
}

// Renders by the back end that was asked for. Returns validation messages.
std::vector<std::string> trace(const RenderOptions& options, const BakedScene& scene,
                               const TraceParams& params, bool aovs, Frame& frame,
                               RenderStatistics& statistics) {
  const KernelChoice choice{options.solver, aovs || options.evals, options.evals};
  if (options.backend == Backend::vulkan) {
    return trace_on_vulkan(options, scene, params, choice, frame, statistics);
  }
  if (options.backend == Backend::oracle) {
    trace_on_host(options, "the oracle, double precision", statistics,
                  [&](const std::function<void(uint32_t)>& progress) {
                    frame = frame_of(trace_with_oracle(scene, params, progress), scene, params);
                  });
    return {};
  }
  trace_on_host(options, "the kernel as C++, single precision", statistics,
                [&](const std::function<void(uint32_t)>& progress) {
                  trace_on_cpu(scene, params, choice, frame, progress);
                });
  return {};
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
    BakedScene baked = bake(built.mesh, {options.surface, options.alpha, options.shell});
    if (options.solver == SOLVER_ROBUST) baked.cages = bake_cages(baked);
    return baked;
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
  if (options.evals) statistics.counts = count_work(frame);

  if (format == ImageFormat::png) {
    write_png(frame, image);
  } else {
    write_exr(frame, options.evals, image);
  }
  if (stats) stats->write(to_json(options, statistics));
  image.commit();
  if (stats) stats->commit();
  fmt::print("{}{}\n", to_text(options, statistics), options.output);

  for (const std::string& message : messages) fmt::print(stderr, "validation: {}\n", message);
  return messages.empty() ? exit_done : exit_internal;
}

}  // namespace trisect
