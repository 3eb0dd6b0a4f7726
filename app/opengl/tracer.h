// The OpenGL back end: a baked scene and trace parameters in, a frame out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/buffers/buffer_limits.h"
#include "app/buffers/kernel_choice.h"
#include "app/dispatch/backend.h"
#include "app/dispatch/submit_budget.h"
#include "app/frame/frame.h"
#include "app/frame/frame_time.h"
#include "app/opengl/frame_target.h"
#include "app/opengl/objects.h"

namespace trisect::opengl {

class Tracer {
 public:
  // Uploads the scene and compiles the shaders for it. A context must be current, and must stay so
  // for the lifetime of the object. width, height: of all frames, in pixels. choice: its
  // acceleration is Accel::list, and GlPath::fragment has no shadows. buffer_limit: the most bytes
  // of a buffer, if less than OpenGL's own limit. Throws DeviceError if OpenGL cannot hold the
  // scene or the image.
  Tracer(const BakedScene& scene, uint32_t width, uint32_t height, const KernelChoice& choice,
         GlPath path, std::size_t buffer_limit = kNoLimit);

  // As VulkanTracer::render(), but params.width and .height must be those of the constructor, and
  // FrameTime::gpu_ms is measured by the host's clock.
  std::optional<FrameTime> render(const TraceParams& params, Frame& frame,
                                  const FractionProgress& progress = {});

  // What the constructor took for the upload, by the host's clock.
  [[nodiscard]] double upload_ms() const { return upload_ms_; }

 private:
  void bind() const;
  // Calls `work`, which draws or dispatches, with these push constants. Returns how many rays
  // paused.
  uint32_t submit(const QueuePass& pass, const TilePush& push, const std::function<void()>& work);
  // These return milliseconds, or nothing if progress stopped them.
  std::optional<double> compute_band(const Program& program, uint32_t first_row, uint32_t rows,
                                     const FractionProgress& progress);
  std::optional<double> draw_band(const TraceParams& params, uint32_t first_row, uint32_t rows,
                                  const FractionProgress& progress);
  std::optional<double> render_band(const TraceParams& params, uint32_t first_row, uint32_t rows,
                                    const FractionProgress& progress);
  void read_buffers(uint32_t first_row, uint32_t rows, Frame& frame) const;

  uint32_t width_;
  uint32_t height_;
  bool aovs_;
  GlPath path_;
  std::size_t buffer_limit_;
  uint32_t band_rows_;
  Buffer triangles_;
  Buffer subpatches_;
  Buffer params_;
  Buffer push_;
  Buffer queued_;
  uint64_t bytes_read_ = 0;
  Buffer paused_;  // PausedRays. Compute: two halves as in RayQueue; fragment: one for each pixel
  Program program_;
  std::optional<Program> shadow_program_;
  // The outputs of the compute path.
  std::optional<Buffer> colors_;
  std::optional<Buffer> aovs_buffer_;
  // The outputs of the fragment path.
  std::optional<FrameTarget> target_;
  VertexArray vertices_;
  double upload_ms_ = 0.0;
  SubmitBudget budget_;
};

}  // namespace trisect::opengl
