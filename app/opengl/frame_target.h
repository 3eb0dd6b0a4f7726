// A framebuffer for the outputs of fragment shaders that make a frame. A context must be current,
// the same in all functions.
#pragma once

#include <cstdint>
#include <vector>

#include "app/frame/frame.h"
#include "app/opengl/objects.h"

namespace trisect::opengl {

class FrameTarget {
 public:
  // width, rows: in pixels. It has attachments for the colour and, with aovs, for the outputs of
  // shaders/fragment_outputs.glsl. Throws DeviceError if OpenGL has no such framebuffers or no
  // memory.
  FrameTarget(uint32_t width, uint32_t rows, bool aovs);

  // The next draws go into it.
  void bind() const;

  // Adds a depth buffer. Throws DeviceError if there is no memory.
  void add_depth();

  // Reads the framebuffer's lowest `rows` rows into the frame's rows from first_row on. The frame
  // counts rows from the top, the framebuffer from the bottom: the order of the rows is reversed.
  // It must be the framebuffer that is bound.
  void read(uint32_t first_row, uint32_t rows, Frame& frame) const;

 private:
  uint32_t width_;
  uint32_t rows_;
  bool aovs_;
  std::vector<Texture> textures_;
  Framebuffer framebuffer_;
};

}  // namespace trisect::opengl
