// A framebuffer for what fragments write of a frame.
#pragma once

#include <cstdint>
#include <vector>

#include "app/frame/frame.h"
#include "app/opengl/objects.h"

namespace trisect::opengl {

class FrameTarget {
 public:
  // Colour, and with `aovs` the outputs of PixelAovs as trace_list.frag has them. A context must be
  // current, and stay so. Throws DeviceError if OpenGL has no such framebuffers.
  FrameTarget(uint32_t width, uint32_t rows, bool aovs);

  void bind() const;

  // Adds a depth buffer.
  void add_depth();

  // The lowest rows as the frame's from first_row on: OpenGL counts from below.
  void read(uint32_t first_row, uint32_t rows, Frame& frame) const;

 private:
  uint32_t width_;
  uint32_t rows_;
  bool aovs_;
  std::vector<Texture> textures_;
  Framebuffer framebuffer_;
};

}  // namespace trisect::opengl
