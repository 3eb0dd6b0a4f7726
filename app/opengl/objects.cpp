#include "app/opengl/objects.h"

#include <fmt/format.h>

#include <stdexcept>

#include "app/base/error.h"

namespace trisect::opengl {
namespace {

struct Shader : Owned<[](GLuint name) { glDeleteShader(name); }> {
  using Owned::Owned;
};

// Throws DeviceError with the compiler's log, on one line, if a shader's or a program's status is
// not GL_TRUE. get, get_log: glGetShaderiv and glGetShaderInfoLog, or those of programs.
template <typename Get, typename GetLog>
void expect_status(GLuint name, GLenum status, Get get, GetLog get_log, const char* what) {
  GLint done = GL_FALSE;
  get(name, status, &done);
  if (done == GL_TRUE) return;
  std::string text(2000, '\0');
  GLsizei length = 0;
  get_log(name, static_cast<GLsizei>(text.size()), &length, text.data());
  text.resize(static_cast<std::size_t>(length));
  for (char& c : text) c = c == '\n' ? ' ' : c;
  throw DeviceError(fmt::format("OpenGL did not {}: {}", what, text));
}

Shader compiled(const std::string& head, const Stage& stage) {
  Shader shader(glCreateShader(stage.kind));
  const char* const texts[] = {head.c_str(), stage.text};
  glShaderSource(shader.get(), 2, texts, nullptr);
  glCompileShader(shader.get());
  expect_status(shader.get(), GL_COMPILE_STATUS, glGetShaderiv, glGetShaderInfoLog,
                "compile a shader");
  return shader;
}

}  // namespace

std::string device_name() {
  return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

VertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArray(name);
}

void check(const std::string& what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) {
    throw OutOfMemory(
        fmt::format("OpenGL has not enough memory: {}; take a smaller image or model.", what));
  }
  if (error == GL_CONTEXT_LOST) {
    throw DeviceLost(
        fmt::format("the OpenGL device was lost: {}; try again, then with a smaller image.", what));
  }
  throw DeviceError(fmt::format("OpenGL reports error {:#x}: {}.", error, what));
}

Program make_program(const std::string& head, const std::vector<Stage>& stages) {
  Program program(glCreateProgram());
  std::vector<Shader> shaders;
  for (const Stage& stage : stages) {
    shaders.push_back(compiled(head, stage));
    glAttachShader(program.get(), shaders.back().get());
  }
  glLinkProgram(program.get());
  expect_status(program.get(), GL_LINK_STATUS, glGetProgramiv, glGetProgramInfoLog,
                "link a program");
  return program;
}

Buffer::Buffer(std::size_t size, const std::string& name) : size_(size) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  buffer_ = Owned<free_buffer>(buffer);
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(size), nullptr, GL_DYNAMIC_COPY);
  check(fmt::format("no {} MiB for the {} buffer", size >> 20U, name));
}

void Buffer::write(std::span<const std::byte> bytes) {
  if (bytes.size() != size_) throw std::logic_error("a part of a buffer is written");
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer_.get());
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(size_), bytes.data(), GL_DYNAMIC_COPY);
}

void Buffer::read(std::size_t offset, std::span<std::byte> bytes) const {
  glBindBuffer(GL_COPY_READ_BUFFER, buffer_.get());
  glGetBufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(offset),
                     static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void Buffer::clear() {
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer_.get());
  glClearBufferData(GL_COPY_WRITE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

void Buffer::bind(GLenum target, GLuint binding) const {
  glBindBufferBase(target, binding, buffer_.get());
}

}  // namespace trisect::opengl
