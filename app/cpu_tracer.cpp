#include "app/cpu_tracer.h"

#include <algorithm>

#include "app/kernel_float.h"
#include "app/parallel_rows.h"

namespace trisect {

void trace_on_cpu(const BakedScene& scene, const TraceParams& params, const KernelChoice& choice,
                  Frame& frame, const std::function<void(uint32_t)>& between_rows) {
  frame.width = params.width;
  frame.height = params.height;
  const std::size_t pixels = std::size_t{params.width} * params.height;
  frame.colors.resize(pixels);
  frame.aovs.resize(choice.aovs ? pixels : 0);
  const in_float::Kernel shared = in_float::kernel_of(scene, params, choice);
  const auto row = [&](uint32_t y) {
    in_float::Kernel kernel = shared;
    for (uint32_t x = 0; x < params.width; ++x) {
      const std::size_t pixel = std::size_t{y} * params.width + x;
      PixelAovs aovs{};
      kernel.trace_pixel({x, y}, frame.colors[pixel], aovs);
      if (choice.aovs) frame.aovs[pixel] = aovs;
    }
  };
  parallel_rows(params.height, row, between_rows);
}

std::vector<CastHit> cast_on_cpu(const BakedScene& scene, const TraceParams& params, uint solver,
                                 std::span<const CastRay> rays) {
  std::vector<CastHit> hits(rays.size());
  constexpr std::size_t batch = 1024;
  const in_float::Kernel shared = in_float::kernel_of(scene, params, {solver, false, true});
  const auto row = [&](uint32_t y) {
    in_float::Kernel kernel = shared;
    const std::size_t first = y * batch;
    const std::size_t end = std::min(first + batch, rays.size());
    for (std::size_t i = first; i < end; ++i) hits[i] = kernel.cast_ray(rays[i]);
  };
  parallel_rows(static_cast<uint32_t>((rays.size() + batch - 1) / batch), row, {});
  return hits;
}

}  // namespace trisect
