#include <array>
#include <limits>
#include <memory>

#include "app/base/parallel_rows.h"
#include "app/base/stopwatch.h"
#include "app/bench/contender.h"
#include "app/bench/embree_triangles.h"
#include "app/cli/interrupt.h"
#include "app/dispatch/kernel_float.h"

namespace trisect::bench {
namespace {

using in_float::Kernel;

// A packet is a square of 4 x 4 pixels.
constexpr uint32_t kSide = 4;
constexpr uint32_t kPacket = kSide * kSide;

class OnEmbree : public Contender {
 public:
  OnEmbree(const BakedScene& scene, const Tessellation& flat, const TraceParams& params,
           EmbreeRays rays)
      : params_(params),
        n_(flat.n),
        rays_(rays),
        kernel_(in_float::kernel_of(scene, params_, {})),
        triangles_(flat.vertices, flat.triangles) {}

  Timing render(Frame& frame) override {
    const Stopwatch watch;
    const CpuStopwatch cpu;
    trace(frame, false);
    return {watch.milliseconds(), cpu.milliseconds()};
  }

  void inspect(Frame& frame) override { trace(frame, true); }

  [[nodiscard]] std::size_t bytes() const override { return triangles_.bytes(); }

 private:
  void trace(Frame& frame, bool aovs) const {
    frame.resize(params_.width, params_.height, aovs);
    const bool packets = rays_ == EmbreeRays::packets;
    parallel_rows((params_.height + kSide - 1) / kSide,
                  [&](uint32_t row) {
                    Kernel kernel = kernel_;
                    kernel.AOVS = aovs;
                    for (uint32_t x = 0; x < params_.width; x += kSide) {
                      if (packets) {
                        trace_packet(kernel, x, row * kSide, frame);
                      } else {
                        trace_each(kernel, x, row * kSide, frame);
                      }
                    }
                  },
                  [](uint32_t) { return not_interrupted(); });
    stop_if_interrupted();
  }

  // Calls use(x, y, k) for the k-th pixel of a packet that begins at x, y.
  template <typename Use>
  void for_each_pixel(uint32_t x, uint32_t y, Use&& use) const {
    for (uint32_t k = 0; k < kPacket; ++k) {
      const uint32_t px = x + k % kSide;
      const uint32_t py = y + k / kSide;
      if (px < params_.width && py < params_.height) use(px, py, k);
    }
  }

  void trace_packet(Kernel& kernel, uint32_t x, uint32_t y, Frame& frame) const {
    std::array<Kernel::PixelRay, kPacket> rays;
    alignas(64) std::array<int, kPacket> valid{};
    alignas(64) RTCRayHit16 packet;
    for_each_pixel(x, y, [&](uint32_t px, uint32_t py, uint32_t k) {
      rays[k] = kernel.pixel_ray({px, py});
      valid[k] = -1;
      packet.ray.org_x[k] = rays[k].near_point.x;
      packet.ray.org_y[k] = rays[k].near_point.y;
      packet.ray.org_z[k] = rays[k].near_point.z;
      packet.ray.dir_x[k] = rays[k].view.x;
      packet.ray.dir_y[k] = rays[k].view.y;
      packet.ray.dir_z[k] = rays[k].view.z;
      packet.ray.tnear[k] = 0.0F;
      packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
      packet.ray.time[k] = 0.0F;
      packet.ray.mask[k] = ~0U;
      packet.ray.flags[k] = 0;
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    });
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), triangles_.scene(), &context, &packet);
    for_each_pixel(x, y, [&](uint32_t px, uint32_t py, uint32_t k) {
      const bool met = packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
      shade(kernel, rays[k], px, py, met ? packet.hit.primID[k] : NO_TRIANGLE, packet.hit.u[k],
            packet.hit.v[k], packet.ray.tfar[k], frame);
    });
  }

  void trace_each(Kernel& kernel, uint32_t x, uint32_t y, Frame& frame) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for_each_pixel(x, y, [&](uint32_t px, uint32_t py, uint32_t) {
      const Kernel::PixelRay ray = kernel.pixel_ray({px, py});
      RTCRayHit one{};
      one.ray = embree_ray(ray.near_point, ray.view);
      one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(triangles_.scene(), &context, &one);
      const bool met = one.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      shade(kernel, ray, px, py, met ? one.hit.primID : NO_TRIANGLE, one.hit.u, one.hit.v,
            one.ray.tfar, frame);
    });
  }

  // flat: the flat triangle that is hit, or NO_TRIANGLE. u, v: its barycentric coordinates there.
  // t: the distance from the ray's near point.
  void shade(Kernel& kernel, const Kernel::PixelRay& ray, uint32_t x, uint32_t y, uint32_t flat,
             float u, float v, float t, Frame& frame) const {
    in_float::Hit hit{};
    hit.triangle = NO_TRIANGLE;
    if (flat != NO_TRIANGLE) {
      hit.triangle = flat / (n_ * n_);
      hit.weights = weights_in_patch(n_, flat % (n_ * n_), u, v);
      hit.z = ray.near_distance + t;
    }
    const std::size_t pixel = std::size_t{y} * params_.width + x;
    PixelAovs aovs{};
    kernel.shade_pixel(ray, hit, frame.colors[pixel], aovs);
    if (kernel.AOVS) frame.aovs[pixel] = aovs;
  }

  TraceParams params_;
  uint32_t n_;
  EmbreeRays rays_;
  Kernel kernel_;
  EmbreeTriangles triangles_;
};

}  // namespace

std::unique_ptr<Contender> on_embree(const BakedScene& scene, const Tessellation& tessellation,
                                     const TraceParams& params, EmbreeRays rays) {
  return std::make_unique<OnEmbree>(scene, tessellation, params, rays);
}

}  // namespace trisect::bench
