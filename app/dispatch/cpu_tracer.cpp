#include "app/dispatch/cpu_tracer.h"

#include "app/base/parallel_rows.h"
#include "app/dispatch/kernel_float.h"

namespace trisect {
namespace {

// A ray pauses after so many steps, some hundredths of a second, to see whether it is to go on.
constexpr int kSteps = 1 << 18;

using in_float::Kernel;

// Returns before the traversal is finished if `stopped` becomes true.
void finish_traversal(Kernel& kernel, const Kernel::PixelRay& ray, const Stopped& stopped,
                      in_float::Traversal& traversal) {
  for (uint pass = 0; !stopped && (pass == 0 || !kernel.is_finished(ray, traversal)); ++pass) {
    traversal.steps = kSteps;
    kernel.resume(ray, pass, traversal);
  }
}

// Casts the shadow ray of a pixel whose camera ray hit what `met` says, along `view`, and darkens
// the pixel's colour if something is in its way.
void cast_shadow(Kernel& kernel, const glm::vec3& view, const Stopped& stopped, PixelAovs& met,
                 vec4& color) {
  const Kernel::PixelRay ray = kernel.shadow_ray(met, view);
  in_float::Traversal traversal = kernel.begin_shadow_traversal(met, view, kSteps);
  finish_traversal(kernel, ray, stopped, traversal);
  if (traversal.hit.triangle != NO_TRIANGLE) color = kernel.shadow_color(met, view);
  met.evaluations += traversal.counts.evaluations;
  met.candidates += traversal.counts.candidates;
}

}  // namespace

bool trace_on_cpu(const BakedScene& scene, const TraceParams& params, const KernelChoice& choice,
                  Frame& frame, const Progress& progress) {
  frame.resize(params.width, params.height, choice.aovs);
  const Kernel shared = in_float::kernel_of(scene, params, choice);
  const auto row = [&](uint32_t y, const Stopped& stopped) {
    Kernel kernel = shared;
    Kernel shadows = shared;
    shadows.SHADOWS = true;
    for (uint32_t x = 0; x < params.width && !stopped; ++x) {
      const std::size_t pixel = std::size_t{y} * params.width + x;
      PixelAovs aovs{};
      const Kernel::PixelRay ray = kernel.pixel_ray({x, y});
      in_float::Traversal traversal = kernel.begin_traversal(kSteps);
      finish_traversal(kernel, ray, stopped, traversal);
      kernel.finish_pixel(ray, traversal, frame.colors[pixel], aovs);
      if (choice.shadows) cast_shadow(shadows, ray.view, stopped, aovs, frame.colors[pixel]);
      if (choice.aovs) frame.aovs[pixel] = aovs;
    }
  };
  return parallel_rows(params.height, row, progress);
}

std::vector<CastHit> cast_on_cpu(const BakedScene& scene, const TraceParams& params, uint solver,
                                 std::span<const CastRay> rays) {
  std::vector<CastHit> hits(rays.size());
  const Kernel shared = in_float::kernel_of(scene, params, {solver, false, true});
  parallel_chunks(rays.size(), kChunk, [&](std::size_t first, std::size_t end) {
    const Stopped never = false;
    Kernel kernel = shared;
    for (std::size_t i = first; i < end; ++i) {
      const Kernel::PixelRay ray = kernel.ray_of_cast(rays[i]);
      in_float::Traversal traversal = kernel.begin_traversal(kSteps);
      finish_traversal(kernel, ray, never, traversal);
      hits[i] = kernel.cast_result(ray, traversal);
    }
  });
  return hits;
}

}  // namespace trisect
