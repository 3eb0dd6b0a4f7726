#include "app/view/error_map.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "app/accuracy/accuracy.h"
#include "app/oracle/oracle_tracer.h"

namespace trisect::view {
namespace {

// What the error map shows of a pixel: see ErrorMap::errors.
float shown_error(const ClassifiedRay& ray) {
  switch (ray.verdict) {
    case RayVerdict::undecidable:
      return ERROR_UNDECIDED;
    case RayVerdict::both_miss:
      return ERROR_NOTHING;
    case RayVerdict::not_a_number:
    case RayVerdict::wrong_hit:
    case RayVerdict::missed:
      return ERROR_WRONG;
    case RayVerdict::hit:
    case RayVerdict::wrong_patch:
    case RayVerdict::wrong_root:
      break;
  }
  return static_cast<float>(ray.off_surface);
}

ErrorMap map_of(const BakedScene& scene, const TraceParams& params, const Frame& frame,
                const OracleFrame& truth) {
  ErrorMap map;
  map.width = frame.width;
  map.height = frame.height;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const ClassifiedRay ray = classify_pixel(frame, truth, i, params, scene.radius);
    map.errors.emplace_back(shown_error(ray), 0.0F, 0.0F, 0.0F);
  }
  const Accuracy accuracy = accuracy_of(frame, truth, scene, params);
  map.summary = fmt::format(
      "{}x{}: {} wrong, {} missed of {} hits; off by {:.1e} at 99 of 100 pixels, {:.1e} at most",
      map.width, map.height, accuracy.wrong_hits, accuracy.missed, accuracy.hits,
      accuracy.off_surface.p99, accuracy.off_surface.max);
  return map;
}

}  // namespace

void ErrorMeasurement::start(std::shared_ptr<const BakedScene> scene, const TraceParams& params,
                             Frame frame) {
  stop();
  stopped_ = false;
  rows_done_ = 0;
  rows_ = params.height;
  running_ = std::async(std::launch::async,
                        [this, scene = std::move(scene), params,
                         frame = std::move(frame)]() -> std::optional<ErrorMap> {
                          const std::optional<OracleFrame> truth =
                              trace_with_oracle(*scene, params, [this](uint32_t rows) {
                                rows_done_ = rows;
                                return !stopped_;
                              });
                          if (!truth) return std::nullopt;
                          return map_of(*scene, params, frame, *truth);
                        });
}

void ErrorMeasurement::stop() {
  stopped_ = true;
  if (running_.valid()) running_.get();
}

std::optional<float> ErrorMeasurement::progress() const {
  if (!running_.valid()) return std::nullopt;
  return static_cast<float>(rows_done_) / static_cast<float>(rows_);
}

std::optional<ErrorMap> ErrorMeasurement::poll() {
  if (!running_.valid() ||
      running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  return running_.get();
}

}  // namespace trisect::view
