#include <optional>

#include "app/base/stopwatch.h"
#include "app/bench/contender.h"
#include "app/opengl/rasterizer.h"

namespace trisect::bench {
namespace {

class OnOpengl : public Contender {
 public:
  OnOpengl(const BakedScene& scene, const TraceParams& params, uint32_t level)
      : scene_(scene), params_(params), level_(level), colors_(scene, params, level, false) {}

  Timing render(Frame& frame) override {
    const CpuStopwatch cpu;
    const double ms = colors_.render(frame);
    return {ms, cpu.milliseconds()};
  }

  void inspect(Frame& frame) override {
    opengl::Rasterizer(scene_, params_, level_, true).render(frame);
  }

  [[nodiscard]] std::size_t bytes() const override { return colors_.bytes(); }

 private:
  const BakedScene& scene_;
  TraceParams params_;
  uint32_t level_;
  opengl::Rasterizer colors_;
};

}  // namespace

std::unique_ptr<Contender> on_opengl(const BakedScene& scene, const TraceParams& params,
                                     uint32_t level) {
  return std::make_unique<OnOpengl>(scene, params, level);
}

}  // namespace trisect::bench
