// OpenGL's programs and buffers, owned. A context must be current.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/opengl/gl.h"

namespace trisect::opengl {

// GL_RENDERER.
std::string device_name();

// Throws DeviceError if OpenGL has reported an error since it was asked last. `what`: what was
// done.
void check(const std::string& what);

// An object's name, freed by `Free` at the end.
template <void (*Free)(GLuint)>
class Owned {
 public:
  explicit Owned(GLuint name = 0) : name_(name) {}
  ~Owned() {
    if (name_ != 0) Free(name_);
  }
  Owned(Owned&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;

  [[nodiscard]] GLuint get() const { return name_; }

 private:
  GLuint name_;
};

inline void free_program(GLuint name) {
  glDeleteProgram(name);
}
inline void free_buffer(GLuint name) {
  glDeleteBuffers(1, &name);
}
inline void free_texture(GLuint name) {
  glDeleteTextures(1, &name);
}
inline void free_framebuffer(GLuint name) {
  glDeleteFramebuffers(1, &name);
}
inline void free_vertex_array(GLuint name) {
  glDeleteVertexArrays(1, &name);
}

using Program = Owned<free_program>;
using Texture = Owned<free_texture>;
using Framebuffer = Owned<free_framebuffer>;
using VertexArray = Owned<free_vertex_array>;

VertexArray make_vertex_array();

struct Stage {
  GLenum kind;
  const char* text;
};

// Compiles and links; `head` comes before every stage's text, the version in it. Throws DeviceError
// with the compiler's words.
Program make_program(const std::string& head, const std::vector<Stage>& stages);

class Buffer {
 public:
  // Bytes of zero. Throws DeviceError if there is no memory for them.
  Buffer(std::size_t size, const std::string& name);

  void write(std::span<const std::byte> bytes);
  void read(std::size_t offset, std::span<std::byte> bytes) const;
  void clear();
  void bind(GLenum target, GLuint binding) const;

 private:
  Owned<free_buffer> buffer_;
};

}  // namespace trisect::opengl
