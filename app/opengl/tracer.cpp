#include "app/opengl/tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

#include "app/buffer_limits.h"
#include "app/cage.h"
#include "app/kernels.h"
#include "app/ray_queue.h"
#include "app/stopwatch.h"
#include "app/workgroups.h"
#include "vk/result.h"

namespace trisect::opengl {
namespace {

std::string device_name() {
  return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

std::size_t storage_limit() {
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  return static_cast<std::size_t>(limit);
}

// Rows of the image in memory at a time. The fragment path keeps a paused ray for each pixel, as
// large as a pixel's outputs.
uint32_t band_rows(GlPath path, std::size_t limit, uint32_t width, uint32_t height, bool aovs) {
  static_assert(sizeof(PausedRay) == sizeof(PixelAovs));
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (path == GlPath::fragment && (static_cast<GLint>(width) > most)) {
    throw gpu::Error(fmt::format("device {} has framebuffers of at most {} pixels a side.",
                                 device_name(), most));
  }
  return rows_in_a_band(device_name(), limit, width, height, aovs || path == GlPath::fragment);
}

// What frame_buffers.glsl expects ahead of it.
std::string head_for(const BakedScene& scene, const KernelChoice& choice) {
  std::string head = "#version 430 core\n";
  const auto define = [&](const char* name, uint value) {
    head += fmt::format("#define VALUE_{} {}u\n", name, value);
  };
  define("SURFACE", scene.choice.surface);
  define("SHELL", scene.choice.shell);
  define("SOLVER", choice.solver);
  define("AOVS", choice.aovs ? 1 : 0);
  define("COUNTS", choice.counts ? 1 : 0);
  define("GROUPS", has_groups(scene) ? 1 : 0);
  return head;
}

Program program_for(const BakedScene& scene, const KernelChoice& choice, GlPath path) {
  const std::string head = head_for(scene, choice);
  if (path == GlPath::compute) return make_program(head, {{GL_COMPUTE_SHADER, kTraceListComp}});
  return make_program(head,
                      {{GL_VERTEX_SHADER, kFullScreenVert}, {GL_FRAGMENT_SHADER, kTraceListFrag}});
}

// View and projection of points relative to the eye, from the rays that the other kernels have: its
// inverse takes the clip volume's near face to the image's near points.
glm::dmat4 view_projection(const TraceParams& params) {
  const glm::dvec3 right = glm::dvec3(params.ray_dx) * (0.5 * params.width);
  const glm::dvec3 down = glm::dvec3(params.ray_dy) * (0.5 * params.height);
  const glm::dvec3 center = glm::dvec3(params.ray_corner) + right + down;
  // The far points are the near ones times this: w is 1 at z = -1 and 1 / ratio at z = 1.
  const double ratio = params.eye.w;
  const double w_middle = 0.5 * (1.0 + 1.0 / ratio);
  const double w_slope = 0.5 * (1.0 / ratio - 1.0);
  return glm::inverse(glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(-down, 0.0),
                                 glm::dvec4(0.0, 0.0, 0.0, w_slope), glm::dvec4(center, w_middle)));
}

std::vector<Texture> make_textures(uint32_t width, uint32_t rows, bool aovs) {
  std::vector<Texture> textures;
  constexpr std::array<GLenum, 4> formats{GL_RGBA32F, GL_RGBA32F, GL_RGBA32F, GL_RGBA32UI};
  for (const GLenum format : formats) {
    GLuint name = 0;
    glGenTextures(1, &name);
    textures.emplace_back(name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexStorage2D(GL_TEXTURE_2D, 1, format, static_cast<GLsizei>(width),
                   static_cast<GLsizei>(rows));
    if (!aovs) break;
  }
  check(fmt::format("no memory for a framebuffer of {}x{}", width, rows));
  return textures;
}

Framebuffer make_framebuffer(const std::vector<Texture>& textures) {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  Framebuffer framebuffer(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  std::vector<GLenum> attachments;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    attachments.push_back(static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i));
    glFramebufferTexture(GL_FRAMEBUFFER, attachments.back(), textures[i].get(), 0);
  }
  glDrawBuffers(static_cast<GLsizei>(attachments.size()), attachments.data());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw gpu::Error(fmt::format("device {} has no framebuffers of floats.", device_name()));
  }
  return framebuffer;
}

VertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArray(name);
}

// An attachment's pixels, rows from below.
template <typename Pixel>
std::vector<Pixel> read_attachment(std::size_t attachment, GLenum format, GLenum type,
                                   uint32_t width, uint32_t rows) {
  std::vector<Pixel> pixels(std::size_t{width} * rows);
  glReadBuffer(static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + attachment));
  glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(rows), format, type,
               pixels.data());
  return pixels;
}

}  // namespace

Tracer::Tracer(const BakedScene& scene, uint32_t width, uint32_t height, const KernelChoice& choice,
               GlPath path, std::size_t buffer_limit)
    : width_(width),
      height_(height),
      aovs_(choice.aovs),
      path_(path),
      buffer_limit_(std::min(buffer_limit, storage_limit())),
      band_rows_(band_rows(path, buffer_limit_, width, height, choice.aovs)),
      triangles_(triangle_bytes(device_name(), buffer_limit_, scene), "triangles"),
      cages_(cage_bytes(device_name(), buffer_limit_, scene), "cages"),
      params_(sizeof(TraceParams), "trace parameters"),
      push_(sizeof(TilePush), "push constants"),
      queued_(sizeof(uint32_t), "number of paused rays"),
      paused_(path == GlPath::compute
                  ? std::size_t{2} * groups_of_band(width, 0, band_rows_).most() * kGroupRays *
                        sizeof(PausedRay)
                  : std::size_t{width} * band_rows_ * sizeof(PausedRay),
              "paused rays"),
      program_(program_for(scene, choice, path)) {
  const Stopwatch watch;
  triangles_.write(std::as_bytes(std::span(scene.triangles)));
  if (!scene.cages.empty()) cages_.write(std::as_bytes(std::span(scene.cages)));
  upload_ms_ = watch.milliseconds();
  if (path == GlPath::compute) {
    const std::size_t pixels = std::size_t{width} * band_rows_;
    colors_.emplace(pixels * sizeof(vec4), "colors");
    aovs_buffer_.emplace((choice.aovs ? pixels : 1) * sizeof(PixelAovs), "AOVs");
  } else {
    textures_ = make_textures(width, band_rows_, choice.aovs);
    framebuffer_ = make_framebuffer(textures_);
    vertices_ = make_vertex_array();
  }
  check("the scene was uploaded");
}

void Tracer::bind() const {
  glUseProgram(program_.get());
  params_.bind(GL_UNIFORM_BUFFER, BINDING_PARAMS);
  triangles_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_TRIANGLES);
  cages_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_CAGES);
  push_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_PUSH);
  paused_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_QUEUE);
  queued_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_QUEUED);
  if (colors_) colors_->bind(GL_SHADER_STORAGE_BUFFER, BINDING_COLOR);
  if (aovs_buffer_) aovs_buffer_->bind(GL_SHADER_STORAGE_BUFFER, BINDING_AOVS);
}

FrameTime Tracer::render(const TraceParams& params, Frame& frame,
                         const std::function<void()>& between_submits) {
  if (params.width != width_ || params.height != height_) {
    throw std::logic_error("the trace parameters are not for this tracer's image size");
  }
  frame.resize(width_, height_, aovs_);

  const Stopwatch watch;
  FrameTime time;
  params_.write(std::as_bytes(std::span(&params, 1)));
  bind();
  for (uint32_t row = 0; row < height_; row += band_rows_) {
    const uint32_t rows = std::min(band_rows_, height_ - row);
    if (path_ == GlPath::compute) {
      time.gpu_ms += compute_band(row, rows, between_submits);
      read_buffers(row, rows, frame);
    } else {
      time.gpu_ms += draw_band(params, row, rows, between_submits);
      read_framebuffer(row, rows, frame);
    }
  }
  check("a frame was rendered");
  time.wall_ms = watch.milliseconds();
  return time;
}

uint32_t Tracer::submit(const TilePush& push, const std::function<void()>& work) {
  push_.write(std::as_bytes(std::span(&push, 1)));
  queued_.clear();
  work();
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  uint32_t queued = 0;
  // Waits for the work.
  queued_.read(0, std::as_writable_bytes(std::span(&queued, 1)));
  return queued;
}

double Tracer::compute_band(uint32_t first_row, uint32_t rows,
                            const std::function<void()>& between_submits) {
  const GroupRange groups = groups_of_band(width_, first_row, rows);
  double total_ms = 0.0;
  for (uint32_t group = groups.begin; group < groups.end;) {
    const uint32_t count = std::min({budget_.groups(), groups.end - group, groups.most()});
    const Stopwatch watch;
    walk_all(RayQueue::kSteps, groups.most() * kGroupRays, [&](const QueuePush& queue) {
      const uint32_t submitted =
          queue.pass == 0 ? count : (queue.resumed + kGroupRays - 1) / kGroupRays;
      return submit({queue, group, first_row}, [&] { glDispatchCompute(submitted, 1, 1); });
    });
    const double ms = watch.milliseconds();
    total_ms += ms;
    group += count;
    budget_.record(count, ms);
    if (between_submits) between_submits();
  }
  return total_ms;
}

double Tracer::draw_band(const TraceParams& params, uint32_t first_row, uint32_t rows,
                         const std::function<void()>& between_submits) {
  // OpenGL counts rows from below: the band's lowest one is this.
  const uint32_t lowest = height_ - first_row - rows;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
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
    walk_all(RayQueue::kSteps, 0, [&](const QueuePush& queue) {
      return submit({queue, lowest, first_row}, [] { glDrawArrays(GL_TRIANGLE_STRIP, 0, 4); });
    });
    const double ms = watch.milliseconds();
    total_ms += ms;
    row += count;
    budget_.record(count, ms);
    if (between_submits) between_submits();
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

void Tracer::read_framebuffer(uint32_t first_row, uint32_t rows, Frame& frame) const {
  // Calls `put` with pairs of indices, of a pixel in the framebuffer and in the frame.
  const auto for_each_pixel = [&](auto&& put) {
    for (uint32_t y = 0; y < rows; ++y) {
      for (uint32_t x = 0; x < width_; ++x) {
        put(std::size_t{rows - 1 - y} * width_ + x, std::size_t{first_row + y} * width_ + x);
      }
    }
  };
  const auto colors = read_attachment<vec4>(0, GL_RGBA, GL_FLOAT, width_, rows);
  for_each_pixel([&](std::size_t from, std::size_t to) { frame.colors[to] = colors[from]; });
  if (!aovs_) return;
  const auto normals = read_attachment<vec4>(1, GL_RGBA, GL_FLOAT, width_, rows);
  const auto geometric = read_attachment<vec4>(2, GL_RGBA, GL_FLOAT, width_, rows);
  const auto rest = read_attachment<glm::uvec4>(3, GL_RGBA_INTEGER, GL_UNSIGNED_INT, width_, rows);
  for_each_pixel([&](std::size_t from, std::size_t to) {
    PixelAovs& aov = frame.aovs[to];
    aov.normal_z = normals[from];
    aov.geometric_u = geometric[from];
    std::memcpy(&aov.v, &rest[from].x, sizeof(aov.v));
    aov.triangle = rest[from].y;
    aov.evaluations = rest[from].z;
    aov.candidates = rest[from].w;
  });
}

}  // namespace trisect::opengl
