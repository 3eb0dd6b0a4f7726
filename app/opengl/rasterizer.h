// The usual way to draw curved triangles, against which the tracers are measured: tessellated by
// OpenGL's tessellation shaders and rasterised.
#pragma once

#include <cstdint>

#include "app/bake/bake.h"
#include "app/frame/frame.h"
#include "app/opengl/frame_target.h"
#include "app/opengl/objects.h"

namespace trisect::opengl {

class Rasterizer {
 public:
  // Uploads the scene and compiles the shaders for it. A context must be current, and must stay so
  // for the lifetime of the object. level: of tessellation, 1 to 64, which is what OpenGL
  // guarantees. params: of all frames. aovs: frames have PixelAovs too. Throws DeviceError if
  // OpenGL cannot hold the scene or the image.
  Rasterizer(const BakedScene& scene, const TraceParams& params, uint32_t level, bool aovs);

  // Renders into `frame`. Returns the milliseconds by the host's clock from the first command until
  // the image is drawn, without the time to read it back.
  double render(Frame& frame);

  // Bytes of the scene's buffer.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  void draw() const;

  TraceParams params_;
  uint32_t level_;
  bool aovs_;
  std::size_t bytes_;
  GLsizei patches_;
  Buffer triangles_;
  Buffer params_buffer_;
  Program sky_;
  Program surface_;
  FrameTarget target_;
  VertexArray vertices_;
};

}  // namespace trisect::opengl
