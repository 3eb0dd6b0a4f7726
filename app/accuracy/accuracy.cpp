#include "app/accuracy/accuracy.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "app/oracle/oracle_tracer.h"

namespace trisect {
namespace {

using glm::dvec3;

// The pixels that both hit, one after the other.
struct Errors {
  std::vector<double> off_surface;
  std::vector<double> depth_ulp;
  std::vector<double> normal_degrees;
};

}  // namespace

bool has_nan(const vec4& color, const PixelAovs& aov) {
  return glm::any(glm::isnan(color)) || glm::any(glm::isnan(aov.normal_z)) ||
         glm::any(glm::isnan(aov.geometric_u)) || std::isnan(aov.v);
}

PixelError pixel_error(const TraceParams& params, uint32_t x, uint32_t y,
                       const OracleAnswer& answer, const PixelAovs& aov) {
  const OraclePixelRay pixel = oracle_pixel_ray(params, x, y);
  const double depth =
      std::abs(static_cast<double>(aov.normal_z.w) - (pixel.anchor_distance + answer.root.t));
  return {depth * std::abs(glm::dot(answer.root.normal, pixel.ray.direction)),
          depth / ulp_of(aov.normal_z.w)};
}

Accuracy accuracy_of(const Frame& frame, const OracleFrame& truth, const BakedScene& scene,
                     const TraceParams& params) {
  if (frame.aovs.size() != truth.pixels.size()) {
    throw std::logic_error("the frame has no AOVs or is not of the oracle's size");
  }
  Accuracy accuracy;
  accuracy.pixels = truth.pixels.size();
  Errors errors;
  std::vector<double> evaluations;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const OracleAnswer& answer = truth.pixels[i];
    const PixelAovs& aov = frame.aovs[i];
    if (aov.candidates > 0) {
      evaluations.push_back(static_cast<double>(aov.evaluations) / aov.candidates);
    }
    if (has_nan(frame.colors[i], aov)) ++accuracy.nans;
    if (answer.hit) ++accuracy.hits;
    if (!answer.decidable) {
      ++accuracy.undecidable;
      continue;
    }
    const bool hit = aov.triangle != NO_TRIANGLE;
    if (hit && !answer.hit) ++accuracy.wrong_hits;
    if (!hit && answer.hit) ++accuracy.missed;
    if (!hit || !answer.hit) continue;
    const auto x = static_cast<uint32_t>(i % truth.width);
    const auto y = static_cast<uint32_t>(i / truth.width);
    const PixelError error = pixel_error(params, x, y, answer, aov);
    if (aov.triangle != answer.root.triangle && !(error.off_surface <= kTie * scene.radius)) {
      ++accuracy.wrong_patches;
      continue;
    }
    errors.off_surface.push_back(error.off_surface / scene.radius);
    errors.depth_ulp.push_back(error.depth_ulp);
    // A tie's normal is that of the other face.
    if (aov.triangle == answer.root.triangle) {
      errors.normal_degrees.push_back(degrees_between(dvec3(aov.geometric_u), answer.root.normal));
    }
  }
  accuracy.off_surface = quantiles_of(std::move(errors.off_surface));
  accuracy.depth_ulp = quantiles_of(std::move(errors.depth_ulp));
  accuracy.normal_degrees = quantiles_of(std::move(errors.normal_degrees));
  accuracy.median_evaluations = quantiles_of(std::move(evaluations)).p50;
  return accuracy;
}

}  // namespace trisect
