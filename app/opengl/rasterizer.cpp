#include "app/opengl/rasterizer.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <span>

#include "app/base/stopwatch.h"
#include "app/buffers/buffer_limits.h"
#include "app/buffers/kernels.h"
#include "app/opengl/projection.h"
#include "app/opengl/shader_head.h"

namespace trisect::opengl {
namespace {

// Most vertices that tessellation may make of one draw. With 59,000, Mesa 22.3's llvmpipe takes a
// hundred times as long and draws wrong triangles; with 45,000 it does not.
constexpr GLsizei kVerticesAtOnce = 32768;

}  // namespace

Rasterizer::Rasterizer(const BakedScene& scene, const TraceParams& params, uint32_t level,
                       bool aovs)
    : params_(params),
      level_(level),
      aovs_(aovs),
      bytes_(triangle_bytes(device_name(), kNoLimit, scene)),
      patches_(static_cast<GLsizei>(scene.triangles.size())),
      triangles_(bytes_, "triangles"),
      params_buffer_(sizeof(TraceParams), "trace parameters"),
      sky_(make_program(shader_head(scene, {SOLVER_ROBUST, aovs}, false),
                        {{GL_VERTEX_SHADER, glsl_of("full_screen.vert")},
                         {GL_FRAGMENT_SHADER, glsl_of("sky.frag")}})),
      surface_(make_program(shader_head(scene, {SOLVER_ROBUST, aovs}, false),
                            {{GL_VERTEX_SHADER, glsl_of("tessellated.vert")},
                             {GL_TESS_CONTROL_SHADER, glsl_of("tessellated.tesc")},
                             {GL_TESS_EVALUATION_SHADER, glsl_of("tessellated.tese")},
                             {GL_FRAGMENT_SHADER, glsl_of("tessellated.frag")}})),
      target_(params.width, params.height, aovs),
      vertices_(make_vertex_array()) {
  triangles_.write(std::as_bytes(std::span(scene.triangles)));
  params_buffer_.write(std::as_bytes(std::span(&params_, 1)));
  target_.add_depth();
}

double Rasterizer::render(Frame& frame) {
  frame.resize(params_.width, params_.height, aovs_);
  const Stopwatch watch;
  draw();
  glFinish();
  const double ms = watch.milliseconds();
  check("a frame was drawn");
  target_.read(0, params_.height, frame);
  return ms;
}

void Rasterizer::draw() const {
  const glm::dmat4 camera = view_projection(params_);
  const glm::mat4 camera_single(camera);
  target_.bind();
  glBindVertexArray(vertices_.get());
  glViewport(0, 0, static_cast<GLsizei>(params_.width), static_cast<GLsizei>(params_.height));
  glDisable(GL_SCISSOR_TEST);
  params_buffer_.bind(GL_UNIFORM_BUFFER, BINDING_PARAMS);
  triangles_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_TRIANGLES);

  glDisable(GL_DEPTH_TEST);
  glUseProgram(sky_.get());
  glUniformMatrix4dv(glGetUniformLocation(sky_.get(), "view_projection"), 1, GL_FALSE,
                     glm::value_ptr(camera));
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);

  glEnable(GL_DEPTH_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);
  glUseProgram(surface_.get());
  glUniformMatrix4fv(glGetUniformLocation(surface_.get(), "camera"), 1, GL_FALSE,
                     glm::value_ptr(camera_single));
  glUniform1f(glGetUniformLocation(surface_.get(), "level"), static_cast<float>(level_));
  glPatchParameteri(GL_PATCH_VERTICES, 1);
  const GLint first_location = glGetUniformLocation(surface_.get(), "first");
  const GLsizei at_once = kVerticesAtOnce / static_cast<GLsizei>((level_ + 1) * (level_ + 2) / 2);
  for (GLsizei first = 0; first < patches_; first += at_once) {
    glUniform1ui(first_location, static_cast<GLuint>(first));
    glDrawArrays(GL_PATCHES, 0, std::min(at_once, patches_ - first));
  }
  glDisable(GL_DEPTH_TEST);
}

}  // namespace trisect::opengl
