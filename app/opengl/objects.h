// OpenGL's objects, owned. A context must be current in all functions, destructors too: that in
// which the object was made.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/opengl/gl.h"

namespace trisect::opengl {

// The device's name: GL_RENDERER.
std::string device_name();

// Throws OutOfMemory, DeviceLost or another DeviceError if OpenGL has recorded an error since the
// last call. what: what was done, for the message.
void check(const std::string& what);

// The name (number) of an object, which Free deletes with its owner; 0 is none. Move assignment
// swaps: what this owner held is deleted with the other one.
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
  GLenum kind;       // such as GL_VERTEX_SHADER
  const char* text;  // GLSL without #version
};

// Compiles and links a program. head: #version and definitions that go ahead of every stage's text.
// Throws DeviceError with the compiler's message.
Program make_program(const std::string& head, const std::vector<Stage>& stages);

class Buffer {
 public:
  // size: in bytes, which are undefined at first. name: for the message. Throws DeviceError if
  // there is no memory.
  Buffer(std::size_t size, const std::string& name);

  // Gives the buffer these contents, as many bytes as it has. In new memory: with NVIDIA's driver
  // 580.159 shaders have found zeros where a buffer was cleared and then written.
  void write(std::span<const std::byte> bytes);
  // Copies the buffer's bytes from `offset` on, and waits for commands that write them.
  void read(std::size_t offset, std::span<std::byte> bytes) const;
  // Sets all bytes to 0.
  void clear();
  // Binds it to an indexed target, such as GL_SHADER_STORAGE_BUFFER.
  void bind(GLenum target, GLuint binding) const;

 private:
  std::size_t size_;
  Owned<free_buffer> buffer_;
};

}  // namespace trisect::opengl
