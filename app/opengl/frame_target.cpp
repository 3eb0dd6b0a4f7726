#include "app/opengl/frame_target.h"

#include <fmt/format.h>
#include "app/base/error.h"

#include <array>
#include <cstring>

namespace trisect::opengl {
namespace {

Texture make_texture(GLenum format, uint32_t width, uint32_t rows) {
  GLuint name = 0;
  glGenTextures(1, &name);
  Texture texture(name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexStorage2D(GL_TEXTURE_2D, 1, format, static_cast<GLsizei>(width), static_cast<GLsizei>(rows));
  return texture;
}

std::vector<Texture> make_textures(uint32_t width, uint32_t rows, bool aovs) {
  std::vector<Texture> textures;
  constexpr std::array<GLenum, 4> formats{GL_RGBA32F, GL_RGBA32F, GL_RGBA32F, GL_RGBA32UI};
  for (const GLenum format : formats) {
    textures.push_back(make_texture(format, width, rows));
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
    throw DeviceError(fmt::format("device {} has no framebuffers of floats.", device_name()));
  }
  return framebuffer;
}

// The pixels of an attachment of the bound framebuffer, rows from the bottom.
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

FrameTarget::FrameTarget(uint32_t width, uint32_t rows, bool aovs)
    : width_(width),
      rows_(rows),
      aovs_(aovs),
      textures_(make_textures(width, rows, aovs)),
      framebuffer_(make_framebuffer(textures_)) {}

void FrameTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
}

void FrameTarget::add_depth() {
  textures_.push_back(make_texture(GL_DEPTH_COMPONENT32F, width_, rows_));
  bind();
  glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, textures_.back().get(), 0);
  check(fmt::format("no memory for a depth buffer of {}x{}", width_, rows_));
}

void FrameTarget::read(uint32_t first_row, uint32_t rows, Frame& frame) const {
  // Calls `put` for each pixel, with its index in the framebuffer and its index in the frame.
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
