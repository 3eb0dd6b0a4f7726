#include "app/trace/trace_scene.h"

#include <fmt/format.h>

#include <utility>

#include "app/base/stopwatch.h"
#include "app/base/threads.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/pipeline_store.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/opengl/context.h"
#include "app/opengl/tracer.h"
#include "app/oracle/oracle_tracer.h"

namespace trisect {
namespace {

class VulkanScene final : public SceneTracer {
 public:
  VulkanScene(const TraceRequest& request, const BakedScene& scene, uint32_t width, uint32_t height,
              const KernelChoice& choice)
      : instance_(request.validation), on_device_(std::in_place, instance_, request) {
    device_ = on_device_->device.report().name;
    driver_ = on_device_->device.report().driver;
    on_device_->tracer.emplace(on_device_->device, scene, width, height, choice);
    upload_ms_ = on_device_->tracer->upload_ms();
  }

  std::optional<FrameTime> render(const TraceParams& params, Frame& frame,
                                  const FractionProgress& progress) override {
    return on_device_->tracer->render(params, frame, progress);
  }

  std::vector<std::string> close() override {
    on_device_.reset();
    return instance_.log().messages();
  }

 private:
  // What the instance outlives.
  struct OnDevice {
    OnDevice(const gpu::Instance& instance, const TraceRequest& request)
        : device(instance, request.device), store(device, request.pipeline_folder) {}
    gpu::Device device;
    PipelineStore store;
    std::optional<VulkanTracer> tracer;
  };

  gpu::Instance instance_;
  std::optional<OnDevice> on_device_;
};

class OpenGlScene final : public SceneTracer {
 public:
  OpenGlScene(const TraceRequest& request, const BakedScene& scene, uint32_t width, uint32_t height,
              const KernelChoice& choice)
      : tracer_(scene, width, height, choice, request.gl_path) {
    device_ = context_.device();
    driver_ = context_.driver();
    upload_ms_ = tracer_.upload_ms();
  }

  std::optional<FrameTime> render(const TraceParams& params, Frame& frame,
                                  const FractionProgress& progress) override {
    return tracer_.render(params, frame, progress);
  }

 private:
  opengl::Context context_;
  opengl::Tracer tracer_;
};

// Of what runs in threads of this process.
class HostScene : public SceneTracer {
 public:
  HostScene(const BakedScene& scene, const KernelChoice& choice, const char* driver)
      : scene_(scene), choice_(choice) {
    device_ = fmt::format("CPU, {} threads", worker_threads());
    driver_ = driver;
  }

  std::optional<FrameTime> render(const TraceParams& params, Frame& frame,
                                  const FractionProgress& progress) override {
    const Stopwatch watch;
    const uint32_t rows_of_work = rows_of(params);
    const auto tell = [&](uint32_t rows) {
      return may_go_on(progress, static_cast<double>(rows) / rows_of_work);
    };
    if (!render_rows(params, frame, tell)) return std::nullopt;
    FrameTime time;
    time.wall_ms = watch.milliseconds();
    return time;
  }

 protected:
  [[nodiscard]] virtual uint32_t rows_of(const TraceParams& params) const { return params.height; }
  // False: stopped.
  virtual bool render_rows(const TraceParams& params, Frame& frame, const Progress& progress) = 0;

  const BakedScene& scene_;
  KernelChoice choice_;
};

class CpuScene final : public HostScene {
 public:
  CpuScene(const BakedScene& scene, const KernelChoice& choice)
      : HostScene(scene, choice, "the kernel as C++, single precision") {}

 private:
  bool render_rows(const TraceParams& params, Frame& frame, const Progress& progress) override {
    return trace_on_cpu(scene_, params, choice_, frame, progress);
  }
};

class OracleScene final : public HostScene {
 public:
  OracleScene(const BakedScene& scene, const KernelChoice& choice)
      : HostScene(scene, choice, "the oracle, double precision") {}

 private:
  [[nodiscard]] uint32_t rows_of(const TraceParams& params) const override {
    return params.height * (choice_.shadows ? 2 : 1);
  }

  bool render_rows(const TraceParams& params, Frame& frame, const Progress& progress) override {
    const std::optional<OracleFrame> answers = trace_with_oracle(scene_, params, progress);
    if (!answers) return false;
    frame = frame_of(*answers, scene_, params);
    return !choice_.shadows ||
           cast_oracle_shadows(*answers, scene_, params, frame,
                               [&](uint32_t rows) { return progress(params.height + rows); });
  }
};

}  // namespace

std::unique_ptr<SceneTracer> make_tracer(const TraceRequest& request, const BakedScene& scene,
                                         uint32_t width, uint32_t height,
                                         const KernelChoice& choice) {
  switch (request.backend) {
    case Backend::vulkan:
      return std::make_unique<VulkanScene>(request, scene, width, height, choice);
    case Backend::opengl:
      return std::make_unique<OpenGlScene>(request, scene, width, height, choice);
    case Backend::cpu:
      return std::make_unique<CpuScene>(scene, choice);
    case Backend::oracle:
      break;
  }
  return std::make_unique<OracleScene>(scene, choice);
}

std::optional<std::vector<FrameTime>> trace_runs(SceneTracer& tracer, const TraceRequest& request,
                                                 const TraceParams& params, Frame& frame,
                                                 const FractionProgress& progress) {
  const uint32_t untimed = is_device(request.backend) && request.warm_up ? 1 : 0;
  const double frames = untimed + request.runs;
  std::vector<FrameTime> times;
  for (uint32_t k = 0; k < frames; ++k) {
    const std::optional<FrameTime> time =
        tracer.render(params, frame, part_of(progress, k / frames, (k + 1) / frames));
    if (!time) return std::nullopt;
    if (k >= untimed) times.push_back(*time);
  }
  return times;
}

std::optional<TraceResult> trace_scene(const TraceRequest& request, const BakedScene& scene,
                                       const TraceParams& params, const KernelChoice& choice,
                                       const FractionProgress& progress) {
  const std::unique_ptr<SceneTracer> tracer =
      make_tracer(request, scene, params.width, params.height, choice);
  TraceResult result;
  result.device = tracer->device();
  result.driver = tracer->driver();
  result.upload_ms = tracer->upload_ms();
  auto times = trace_runs(*tracer, request, params, result.frame, progress);
  if (!times) return std::nullopt;
  result.frames = *std::move(times);
  result.messages = tracer->close();
  return result;
}

}  // namespace trisect
