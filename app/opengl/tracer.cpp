#include "app/opengl/tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/base/stopwatch.h"
#include "app/buffers/buffer_limits.h"
#include "app/buffers/kernels.h"
#include "app/dispatch/ray_queue.h"
#include "app/dispatch/workgroups.h"
#include "app/opengl/projection.h"
#include "app/opengl/shader_head.h"

namespace trisect::opengl {
namespace {

std::size_t storage_limit() {
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  return static_cast<std::size_t>(limit);
}

// Rows of the image that the buffers hold at a time. The fragment path has a PausedRay for each
// pixel, which is larger than a pixel's AOVs.
uint32_t band_rows(GlPath path, std::size_t limit, uint32_t width, uint32_t height, bool aovs) {
  static_assert(sizeof(PausedRay) >= sizeof(PixelAovs));
  GLint most_pixels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most_pixels);
  if (path == GlPath::fragment && (static_cast<GLint>(width) > most_pixels)) {
    throw DeviceError(fmt::format("device {} has framebuffers of at most {} pixels a side.",
                                  device_name(), most_pixels));
  }
  if (path == GlPath::compute) return rows_in_a_band(device_name(), limit, width, height, aovs);
  // As many AOVs as there is room for PausedRays.
  const std::size_t room = limit / sizeof(PausedRay) * sizeof(PixelAovs);
  return rows_in_a_band(device_name(), room, width, height, true);
}

Program program_for(const BakedScene& scene, const KernelChoice& choice, GlPath path) {
  const std::string head = shader_head(scene, choice, false);
  if (path == GlPath::compute) {
    return make_program(head, {{GL_COMPUTE_SHADER, glsl_of("trace_list.comp")}});
  }
  return make_program(head, {{GL_VERTEX_SHADER, glsl_of("full_screen.vert")},
                             {GL_FRAGMENT_SHADER, glsl_of("trace_list.frag")}});
}

std::optional<Program> shadow_program_for(const BakedScene& scene, const KernelChoice& choice) {
  if (!choice.shadows) return std::nullopt;
  return make_program(shader_head(scene, choice, true),
                      {{GL_COMPUTE_SHADER, glsl_of("trace_list.comp")}});
}

}  // namespace

Tracer::Tracer(const BakedScene& scene, uint32_t width, uint32_t height, const KernelChoice& choice,
               GlPath path, std::size_t buffer_limit)
    : width_(width),
      height_(height),
      aovs_(choice.aovs),
      path_(path),
      buffer_limit_(std::min(buffer_limit, storage_limit())),
      band_rows_(band_rows(path, buffer_limit_, width, height, choice.writes_aovs())),
      triangles_(triangle_bytes(device_name(), buffer_limit_, scene), "triangles"),
      subpatches_(subpatch_bytes(device_name(), buffer_limit_, scene), "subpatch bounds"),
      params_(sizeof(TraceParams), "trace parameters"),
      push_(sizeof(TilePush), "push constants"),
      queued_(sizeof(QueueState), "number of paused rays"),
      paused_(path == GlPath::compute
                  ? std::size_t{2} * groups_of_band(width, 0, band_rows_).part_limit() *
                        kGroupRays * sizeof(PausedRay)
                  : std::size_t{width} * band_rows_ * sizeof(PausedRay),
              "paused rays"),
      program_(program_for(scene, choice, path)),
      shadow_program_(shadow_program_for(scene, choice)) {
  const Stopwatch watch;
  triangles_.write(std::as_bytes(std::span(scene.triangles)));
  if (!scene.subpatches.empty()) subpatches_.write(std::as_bytes(std::span(scene.subpatches)));
  upload_ms_ = watch.milliseconds();
  if (path == GlPath::compute) {
    const std::size_t pixels = std::size_t{width} * band_rows_;
    colors_.emplace(pixels * sizeof(vec4), "colors");
    aovs_buffer_.emplace((choice.writes_aovs() ? pixels : 1) * sizeof(PixelAovs), "AOVs");
  } else {
    target_.emplace(width, band_rows_, choice.aovs);
    vertices_ = make_vertex_array();
  }
  check("the scene was uploaded");
}

void Tracer::bind() const {
  params_.bind(GL_UNIFORM_BUFFER, BINDING_PARAMS);
  triangles_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_TRIANGLES);
  subpatches_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_SUBPATCHES);
  push_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_PUSH);
  paused_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_QUEUE);
  queued_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_QUEUED);
  if (colors_) colors_->bind(GL_SHADER_STORAGE_BUFFER, BINDING_COLOR);
  if (aovs_buffer_) aovs_buffer_->bind(GL_SHADER_STORAGE_BUFFER, BINDING_AOVS);
}

std::optional<FrameTime> Tracer::render(const TraceParams& params, Frame& frame,
                                        const FractionProgress& progress) {
  if (params.width != width_ || params.height != height_) {
    throw std::logic_error("the trace parameters are not for this tracer's image size");
  }
  frame.resize(width_, height_, aovs_);
  // A frame that was stopped may have left a count.
  bytes_read_ = 0;

  const Stopwatch watch;
  FrameTime time;
  params_.write(std::as_bytes(std::span(&params, 1)));
  bind();
  for (uint32_t row = 0; row < height_; row += band_rows_) {
    const uint32_t rows = std::min(band_rows_, height_ - row);
    const double height = height_;
    const std::optional<double> ms =
        render_band(params, row, rows, part_of(progress, row / height, (row + rows) / height));
    if (!ms) return std::nullopt;
    time.gpu_ms += *ms;
    if (path_ == GlPath::compute) {
      read_buffers(row, rows, frame);
    } else {
      target_->read(row, rows, frame);
    }
  }
  frame.bytes_read = bytes_read_;
  check("a frame was rendered");
  time.wall_ms = watch.milliseconds();
  return time;
}

std::optional<double> Tracer::render_band(const TraceParams& params, uint32_t first_row,
                                          uint32_t rows, const FractionProgress& progress) {
  if (path_ == GlPath::fragment) return draw_band(params, first_row, rows, progress);
  const double camera_rays = shadow_program_ ? 0.5 : 1.0;
  const std::optional<double> ms =
      compute_band(program_, first_row, rows, part_of(progress, 0.0, camera_rays));
  if (!ms || !shadow_program_) return ms;
  const std::optional<double> shadow_ms =
      compute_band(*shadow_program_, first_row, rows, part_of(progress, camera_rays, 1.0));
  return shadow_ms ? std::optional(*ms + *shadow_ms) : std::nullopt;
}

uint32_t Tracer::submit(const QueuePass& pass, const TilePush& push,
                        const std::function<void()>& work) {
  push_.write(std::as_bytes(std::span(&push, 1)));
  QueueState state{};
  state.now = pass;
  queued_.write(std::as_bytes(std::span(&state, 1)));
  work();
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  // Reading the buffer waits for the work.
  queued_.read(0, std::as_writable_bytes(std::span(&state, 1)));
  bytes_read_ += bytes_in(state);
  return state.queued;
}

std::optional<double> Tracer::compute_band(const Program& program, uint32_t first_row,
                                           uint32_t rows, const FractionProgress& progress) {
  const GroupRange groups = groups_of_band(width_, first_row, rows);
  glUseProgram(program.get());
  double total_ms = 0.0;
  for (uint32_t group = groups.begin; group < groups.end;) {
    const uint32_t count = std::min({budget_.groups(), groups.end - group, groups.part_limit()});
    const Stopwatch watch;
    run_until_finished(
        RayQueue::kSteps, groups.part_limit() * kGroupRays, [&](const QueuePass& pass) {
          const uint32_t submitted =
              pass.pass == 0 ? count : (pass.resumed + kGroupRays - 1) / kGroupRays;
          return submit(pass, {.first_group = group, .stride = 1, .first_row = first_row},
                        [&] { glDispatchCompute(submitted, 1, 1); });
        });
    const double ms = watch.milliseconds();
    total_ms += ms;
    group += count;
    budget_.record(count, ms);
    const double done = static_cast<double>(group - groups.begin) / (groups.end - groups.begin);
    if (!may_go_on(progress, done)) return std::nullopt;
  }
  return total_ms;
}

std::optional<double> Tracer::draw_band(const TraceParams& params, uint32_t first_row,
                                        uint32_t rows, const FractionProgress& progress) {
  // The band's lowest row, counted from the bottom of the image as OpenGL does.
  const uint32_t lowest = height_ - first_row - rows;
  glUseProgram(program_.get());
  target_->bind();
  glBindVertexArray(vertices_.get());
  glViewport(0, -static_cast<GLint>(lowest), static_cast<GLsizei>(width_),
             static_cast<GLsizei>(height_));
  glUniformMatrix4dv(glGetUniformLocation(program_.get(), "view_projection"), 1, GL_FALSE,
                     glm::value_ptr(view_projection(params)));
  glEnable(GL_SCISSOR_TEST);
  paused_.clear();
  double total_ms = 0.0;
  for (uint32_t row = 0; row < rows;) {
    const uint32_t count = std::min(budget_.groups(), rows - row);
    glScissor(0, static_cast<GLint>(row), static_cast<GLsizei>(width_),
              static_cast<GLsizei>(count));
    const Stopwatch watch;
    run_until_finished(RayQueue::kSteps, 0, [&](const QueuePass& pass) {
      return submit(pass, {.first_group = lowest, .first_row = first_row},
                    [] { glDrawArrays(GL_TRIANGLE_STRIP, 0, 4); });
    });
    const double ms = watch.milliseconds();
    total_ms += ms;
    row += count;
    budget_.record(count, ms);
    if (!may_go_on(progress, static_cast<double>(row) / rows)) return std::nullopt;
  }
  return total_ms;
}

void Tracer::read_buffers(uint32_t first_row, uint32_t rows, Frame& frame) const {
  const std::size_t first = std::size_t{first_row} * width_;
  const std::size_t count = std::size_t{rows} * width_;
  colors_->read(0, std::as_writable_bytes(std::span(frame.colors).subspan(first, count)));
  if (!aovs_) return;
  aovs_buffer_->read(0, std::as_writable_bytes(std::span(frame.aovs).subspan(first, count)));
}

}  // namespace trisect::opengl
