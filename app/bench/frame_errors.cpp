#include "app/bench/frame_errors.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "app/accuracy/accuracy.h"
#include "app/base/ulp.h"
#include "app/crosscheck/frame_comparison.h"

namespace trisect::bench {
namespace {

using glm::dvec2;
using glm::dvec3;

// The hit pixels that have a pixel without a hit to the left, right, above or below.
std::vector<dvec2> outline_of(const Frame& frame) {
  const auto hit = [&](uint32_t x, uint32_t y) {
    return frame.aovs[std::size_t{y} * frame.width + x].triangle != NO_TRIANGLE;
  };
  std::vector<dvec2> outline;
  for (uint32_t y = 0; y < frame.height; ++y) {
    for (uint32_t x = 0; x < frame.width; ++x) {
      if (!hit(x, y)) continue;
      const bool inside = (x == 0 || hit(x - 1, y)) && (x + 1 == frame.width || hit(x + 1, y)) &&
                          (y == 0 || hit(x, y - 1)) && (y + 1 == frame.height || hit(x, y + 1));
      if (!inside) outline.emplace_back(x, y);
    }
  }
  return outline;
}

}  // namespace

OutlineErrors outline_errors(const Frame& frame, const Frame& truth) {
  const std::vector<dvec2> outline = outline_of(frame);
  const std::vector<dvec2> true_outline = outline_of(truth);
  if (outline.empty() || true_outline.empty()) return {};
  OutlineErrors errors;
  for (const dvec2& point : outline) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const dvec2& other : true_outline) {
      const dvec2 apart = other - point;
      nearest = std::min(nearest, glm::dot(apart, apart));
    }
    const double distance = std::sqrt(nearest);
    errors.mean += distance;
    errors.max = std::max(errors.max, distance);
  }
  errors.mean /= static_cast<double>(outline.size());
  return errors;
}

FrameErrors errors_of(const Frame& frame, const OracleFrame& truth, const Frame& shown,
                      const BakedScene& scene, const TraceParams& params) {
  FrameErrors errors;
  std::vector<double> off;
  std::vector<double> ulp;
  std::vector<double> degrees;
  double squares = 0.0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const OracleAnswer& answer = truth.pixels[i];
    const PixelAovs& aov = frame.aovs[i];
    const ClassifiedRay ray = classify_pixel(frame, truth, i, params, scene.radius);
    if (ray.verdict == RayVerdict::not_a_number) ++errors.nans;
    if (!answer.decidable) {
      ++errors.undecidable;
      continue;
    }
    if (ray.verdict == RayVerdict::both_miss) continue;
    ++seen;
    if (!both_hit(ray.verdict)) {
      errors.wrong += ray.verdict == RayVerdict::wrong_hit ? 1 : 0;
      errors.missed += ray.verdict == RayVerdict::missed ? 1 : 0;
      squares += 1.0;
      continue;
    }
    // A wrong patch or root counts by its distance, like any other error.
    off.push_back(ray.off_surface);
    ulp.push_back(ray.depth_error / ulp_of(aov.normal_z.w));
    degrees.push_back(degrees_between(dvec3(aov.geometric_u), answer.root.normal));
    const double counted = std::min(off.back(), 1.0);
    squares += counted * counted;
  }
  errors.off = quantiles_of(std::move(off));
  errors.depth_ulp = quantiles_of(std::move(ulp));
  errors.normal_degrees = quantiles_of(std::move(degrees));
  errors.rms = seen == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(seen));
  errors.outline = outline_errors(frame, shown);
  const FrameComparison colors = compare(frame, shown);
  errors.color_rmse = colors.color_rmse;
  errors.psnr = colors.psnr;
  return errors;
}

}  // namespace trisect::bench
