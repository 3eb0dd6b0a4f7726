// The standard practice beside which the tracers are measured: the curved triangles divided by
// OpenGL's tessellation shaders and drawn.
#pragma once

#include <cstdint>

#include "app/bake/bake.h"
#include "app/frame/frame.h"
#include "app/opengl/frame_target.h"
#include "app/opengl/objects.h"

namespace trisect::opengl {

class Rasterizer {
 public:
  // Uploads the scene and compiles the shaders for it; a context must be current, and stay so.
  // level: of tessellation, 1 to 64, what OpenGL promises. params: as Tracer::render has them.
  // Throws DeviceError if OpenGL cannot hold the scene or the image.
  Rasterizer(const BakedScene& scene, const TraceParams& params, uint32_t level, bool aovs);

  // Milliseconds by the host's clock, until the image is drawn but not yet read.
  double render(Frame& frame);

  // Of the scene's buffer.
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
