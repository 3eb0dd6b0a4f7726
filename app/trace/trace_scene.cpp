#include "app/trace_scene.h"

#include <fmt/format.h>

#include <thread>

#include "app/cpu_tracer.h"
#include "app/interrupt.h"
#include "app/opengl/context.h"
#include "app/opengl/tracer.h"
#include "app/oracle_tracer.h"
#include "app/pipeline_store.h"
#include "app/progress.h"
#include "app/stopwatch.h"
#include "app/vulkan_tracer.h"

namespace trisect {
namespace {

// The runs of a tracer on a device.
template <typename Tracer>
void run_on_device(const TraceRequest& request, const TraceParams& params, Tracer& tracer,
                   TraceResult& result) {
  result.upload_ms = tracer.upload_ms();
  if (request.warm_up) tracer.render(params, result.frame, stop_if_interrupted);
  for (uint32_t run = 0; run < request.runs; ++run) {
    result.frames.push_back(tracer.render(params, result.frame, stop_if_interrupted));
  }
}

void trace_on_vulkan(const TraceRequest& request, const BakedScene& scene,
                     const TraceParams& params, const KernelChoice& choice, TraceResult& result) {
  const gpu::Instance instance(request.validation);
  {
    const gpu::Device device(instance, request.device);
    const PipelineStore store(device, cache_folder());
    result.device = device.report().name;
    result.driver = device.report().driver;
    VulkanTracer tracer(device, scene, params.width, params.height, choice);
    run_on_device(request, params, tracer, result);
  }
  // Those of the clean-up among them.
  result.messages = instance.log().messages();
}

void trace_on_opengl(const TraceRequest& request, const BakedScene& scene,
                     const TraceParams& params, const KernelChoice& choice, TraceResult& result) {
  const opengl::Context context;
  result.device = context.device();
  result.driver = context.driver();
  opengl::Tracer tracer(scene, params.width, params.height, choice, request.gl_path);
  run_on_device(request, params, tracer, result);
}

// `frame_once` renders one frame, told how many rows are done.
template <typename FrameOnce>
void trace_on_host(const TraceRequest& request, uint32_t rows_of_work, const std::string& driver,
                   TraceResult& result, FrameOnce&& frame_once) {
  result.device = fmt::format("CPU, {} threads", std::thread::hardware_concurrency());
  result.driver = driver;
  for (uint32_t run = 0; run < request.runs; ++run) {
    Progress progress("rendering", rows_of_work);
    const Stopwatch watch;
    frame_once([&](uint32_t rows) { progress.show(rows); });
    FrameTime time;
    time.wall_ms = watch.milliseconds();
    result.frames.push_back(time);
    stop_if_interrupted();
  }
}

}  // namespace

TraceResult trace_scene(const TraceRequest& request, const BakedScene& scene,
                        const TraceParams& params, const KernelChoice& choice) {
  using RowsDone = std::function<void(uint32_t)>;
  TraceResult result;
  switch (request.backend) {
    case Backend::vulkan:
      trace_on_vulkan(request, scene, params, choice, result);
      break;
    case Backend::opengl:
      trace_on_opengl(request, scene, params, choice, result);
      break;
    case Backend::cpu:
      trace_on_host(request, params.height, "the kernel as C++, single precision", result,
                    [&](const RowsDone& progress) {
                      trace_on_cpu(scene, params, choice, result.frame, progress);
                    });
      break;
    case Backend::oracle:
      trace_on_host(request, params.height * (choice.shadows ? 2 : 1),
                    "the oracle, double precision", result, [&](const RowsDone& progress) {
                      const OracleFrame answers = trace_with_oracle(scene, params, progress);
                      result.frame = frame_of(answers, scene, params);
                      if (!choice.shadows) return;
                      cast_oracle_shadows(answers, scene, params, result.frame,
                                          [&](uint32_t rows) { progress(params.height + rows); });
                    });
      break;
  }
  return result;
}

}  // namespace trisect
