#include "app/trace/trace_scene.h"

#include <fmt/format.h>

#include <thread>

#include "app/base/stopwatch.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/pipeline_store.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/opengl/context.h"
#include "app/opengl/tracer.h"
#include "app/oracle/oracle_tracer.h"

namespace trisect {
namespace {

// The runs of a tracer on a device. False: stopped.
template <typename Tracer>
bool run_on_device(const TraceRequest& request, const TraceParams& params, Tracer& tracer,
                   const TraceProgress& progress, TraceResult& result) {
  result.upload_ms = tracer.upload_ms();
  const KeepGoing keep_going = [&] { return !progress || progress(0.0); };
  if (request.warm_up && !tracer.render(params, result.frame, keep_going)) return false;
  for (uint32_t run = 0; run < request.runs; ++run) {
    const std::optional<FrameTime> time = tracer.render(params, result.frame, keep_going);
    if (!time) return false;
    result.frames.push_back(*time);
  }
  return true;
}

bool trace_on_vulkan(const TraceRequest& request, const BakedScene& scene,
                     const TraceParams& params, const KernelChoice& choice,
                     const TraceProgress& progress, TraceResult& result) {
  const gpu::Instance instance(request.validation);
  bool all = false;
  {
    const gpu::Device device(instance, request.device);
    const PipelineStore store(device, request.pipeline_folder);
    result.device = device.report().name;
    result.driver = device.report().driver;
    VulkanTracer tracer(device, scene, params.width, params.height, choice);
    all = run_on_device(request, params, tracer, progress, result);
  }
  // Those of the clean-up among them.
  result.messages = instance.log().messages();
  return all;
}

bool trace_on_opengl(const TraceRequest& request, const BakedScene& scene,
                     const TraceParams& params, const KernelChoice& choice,
                     const TraceProgress& progress, TraceResult& result) {
  const opengl::Context context;
  result.device = context.device();
  result.driver = context.driver();
  opengl::Tracer tracer(scene, params.width, params.height, choice, request.gl_path);
  return run_on_device(request, params, tracer, progress, result);
}

// frame_once(progress) renders one frame of so many rows of work; false: stopped.
template <typename FrameOnce>
bool trace_on_host(const TraceRequest& request, uint32_t rows_of_work, const std::string& driver,
                   const TraceProgress& progress, TraceResult& result, FrameOnce&& frame_once) {
  result.device = fmt::format("CPU, {} threads", std::thread::hardware_concurrency());
  result.driver = driver;
  const auto tell = [&](uint32_t rows) {
    return !progress || progress(static_cast<double>(rows) / rows_of_work);
  };
  for (uint32_t run = 0; run < request.runs; ++run) {
    const Stopwatch watch;
    if (!frame_once(tell)) return false;
    FrameTime time;
    time.wall_ms = watch.milliseconds();
    result.frames.push_back(time);
  }
  return true;
}

bool render_with_oracle(const BakedScene& scene, const TraceParams& params, bool shadows,
                        const Progress& progress, Frame& frame) {
  const std::optional<OracleFrame> answers = trace_with_oracle(scene, params, progress);
  if (!answers) return false;
  frame = frame_of(*answers, scene, params);
  return !shadows || cast_oracle_shadows(*answers, scene, params, frame, [&](uint32_t rows) {
    return progress(params.height + rows);
  });
}

}  // namespace

std::optional<TraceResult> trace_scene(const TraceRequest& request, const BakedScene& scene,
                                       const TraceParams& params, const KernelChoice& choice,
                                       const TraceProgress& progress) {
  TraceResult result;
  bool all = false;
  switch (request.backend) {
    case Backend::vulkan:
      all = trace_on_vulkan(request, scene, params, choice, progress, result);
      break;
    case Backend::opengl:
      all = trace_on_opengl(request, scene, params, choice, progress, result);
      break;
    case Backend::cpu:
      all = trace_on_host(request, params.height, "the kernel as C++, single precision", progress,
                          result, [&](const Progress& rows) {
                            return trace_on_cpu(scene, params, choice, result.frame, rows);
                          });
      break;
    case Backend::oracle:
      all = trace_on_host(
          request, params.height * (choice.shadows ? 2 : 1), "the oracle, double precision",
          progress, result, [&](const Progress& rows) {
            return render_with_oracle(scene, params, choice.shadows, rows, result.frame);
          });
      break;
  }
  return all ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace trisect
