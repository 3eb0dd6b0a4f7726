// The interface of what is measured: a way to render a frame of a scene.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "app/bake/bake.h"
#include "app/bench/tessellation.h"
#include "app/buffers/kernel_choice.h"
#include "app/frame/frame.h"
#include "app/surface/shared.h"
#include "vk/device.h"

namespace trisect::bench {

// Milliseconds of a frame.
struct Timing {
  double ms = 0.0;      // on a Vulkan device by its clock, else by the host's
  double cpu_ms = 0.0;  // of all of the process's threads together: a CPU device's work, too
};

class Contender {
 public:
  Contender() = default;
  virtual ~Contender() = default;
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;
  Contender(Contender&&) = delete;
  Contender& operator=(Contender&&) = delete;

  // Colours only. The copy of a Vulkan device's frame to the host is not timed.
  virtual Timing render(Frame& frame) = 0;

  // The same frame with AOVs and, if the contender counts it, its work. Not for timing.
  virtual void inspect(Frame& frame) = 0;

  // Memory for the scene, without images.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

// A contender's turn among others: draws frames for 20 ms or more, one at least, and gives the time
// of the last. So a frame of a millisecond is not timed right after a pause of the device, or with
// what the contender before left in its caches.
Timing take_turn(Contender& contender, Frame& frame);

// The same of any frames: render() draws one and gives its time.
Timing take_turn(const std::function<Timing()>& render);

// All contenders below keep references to the scene and the device, which must outlive them.

// Writes an image and traces nothing: a lower bound of every frame's time.
std::unique_ptr<Contender> image_only(const gpu::Device& device, const TraceParams& params);

// This program's kernels for a scene and an image size, compiled when they are first needed.
// render() and inspect() decide about AOVs and counts, whatever the choice says.
class Kernels;
std::shared_ptr<Kernels> kernels_for(const gpu::Device& device, const BakedScene& scene,
                                     const KernelChoice& choice);

// Several contenders may share kernels if their images have the same size.
std::unique_ptr<Contender> on_vulkan(std::shared_ptr<Kernels> kernels, const TraceParams& params);

// How rays are handed to Embree.
enum class EmbreeRays {
  packets,  // rtcIntersect16, coherent, of 4 x 4 pixels
  single,   // rtcIntersect1
};

constexpr const char* embree_name(EmbreeRays rays) {
  return rays == EmbreeRays::packets ? "Embree, packets of 16" : "Embree, single rays";
}

// Embree on flat triangles, on all cores, shaded as the other contenders are. Throws OutOfMemory if
// there is not enough memory.
std::unique_ptr<Contender> on_embree(const BakedScene& scene, const Tessellation& tessellation,
                                     const TraceParams& params, EmbreeRays rays);

// OpenGL's tessellation shaders and rasteriser. An OpenGL context must be current, and stay so.
std::unique_ptr<Contender> on_opengl(const BakedScene& scene, const TraceParams& params,
                                     uint32_t level);

}  // namespace trisect::bench
