// One call for every back end: a baked scene and trace parameters in, a frame out.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/buffers/kernel_choice.h"
#include "app/dispatch/backend.h"
#include "app/frame/frame.h"
#include "app/frame/frame_time.h"

namespace trisect {

struct TraceRequest {
  Backend backend = Backend::vulkan;
  GlPath gl_path = GlPath::compute;
  std::string device;       // Vulkan's: a number or a part of a name; empty for the best one
  bool validation = false;  // Vulkan's
  uint32_t runs = 1;        // frames to time
  bool warm_up = true;      // a frame before them, on devices
  // Vulkan's: where compiled pipelines are kept for the next time; empty: nowhere.
  std::optional<std::filesystem::path> pipeline_folder;
};

struct TraceResult {
  Frame frame;
  std::string device;
  std::string driver;
  double upload_ms = 0.0;
  std::vector<FrameTime> frames;      // of the runs
  std::vector<std::string> messages;  // of the validation layer
};

// A scene on a back end, for one frame after the other. For one thread.
class SceneTracer {
 public:
  SceneTracer() = default;
  virtual ~SceneTracer() = default;
  SceneTracer(const SceneTracer&) = delete;
  SceneTracer& operator=(const SceneTracer&) = delete;
  SceneTracer(SceneTracer&&) = delete;
  SceneTracer& operator=(SceneTracer&&) = delete;

  // params: of the scene that make_tracer() got, no wider and higher than it said; for OpenGL just
  // as wide and high. Nothing if progress said stop. Throws DeviceError.
  virtual std::optional<FrameTime> render(const TraceParams& params, Frame& frame,
                                          const FractionProgress& progress) = 0;

  // Lets go of the device. Returns the messages of the validation layer. No frame can follow.
  virtual std::vector<std::string> close() { return {}; }

  [[nodiscard]] const std::string& device() const { return device_; }
  [[nodiscard]] const std::string& driver() const { return driver_; }
  [[nodiscard]] double upload_ms() const { return upload_ms_; }

 protected:
  std::string device_;
  std::string driver_;
  double upload_ms_ = 0.0;
};

// The scene must outlive the tracer. runs and warm_up of the request are not used. Throws
// DeviceError as trace_scene() does. OpenGL's context is current in this thread as long as the
// tracer is there.
std::unique_ptr<SceneTracer> make_tracer(const TraceRequest& request, const BakedScene& scene,
                                         uint32_t width, uint32_t height,
                                         const KernelChoice& choice);

// The frames that the request asks for, after a warm-up if it asks for one on a device; `frame` is
// the last. progress: of all of them. Returns their times, or nothing if progress said stop.
std::optional<std::vector<FrameTime>> trace_runs(SceneTracer& tracer, const TraceRequest& request,
                                                 const TraceParams& params, Frame& frame,
                                                 const FractionProgress& progress);

// Nothing if progress said stop. Throws DeviceError if there is no device or it cannot hold the
// scene, and std::logic_error on Vulkan if the choice needs a BVH (needs_bvh()) and the scene has
// none: build_bvh() makes it. Several threads may call it at a time, but for Backend::opengl, whose
// context is current in one thread only while it runs.
std::optional<TraceResult> trace_scene(const TraceRequest& request, const BakedScene& scene,
                                       const TraceParams& params, const KernelChoice& choice,
                                       const FractionProgress& progress = {});

}  // namespace trisect
