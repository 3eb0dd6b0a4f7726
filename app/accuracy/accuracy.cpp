#include "app/accuracy/accuracy.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "app/base/ulp.h"
#include "app/oracle/oracle_tracer.h"

namespace trisect {
namespace {

using glm::dvec3;

// One number for each pixel that both hit.
struct Errors {
  std::vector<double> off_surface;
  std::vector<double> depth_ulp;
  std::vector<double> normal_degrees;

  void add(const ClassifiedRay& ray, const PixelAovs& aov, const OracleRoot& root) {
    off_surface.push_back(ray.off_surface);
    depth_ulp.push_back(ray.depth_error / ulp_of(aov.normal_z.w));
    if (aov.triangle == root.triangle) {
      normal_degrees.push_back(degrees_between(dvec3(aov.geometric_u), root.normal));
    }
  }
};

bool has_nan(const vec4& color, const PixelAovs& aov) {
  return glm::any(glm::isnan(color)) || glm::any(glm::isnan(aov.normal_z)) ||
         glm::any(glm::isnan(aov.geometric_u)) || std::isnan(aov.v);
}

}  // namespace

ClassifiedRay classify_pixel(const Frame& frame, const OracleFrame& truth, std::size_t pixel,
                             const TraceParams& params, double radius) {
  const PixelAovs& aov = frame.aovs[pixel];
  const OraclePixelRay ray = oracle_pixel_ray(params, static_cast<uint32_t>(pixel % truth.width),
                                              static_cast<uint32_t>(pixel / truth.width));
  // The frame's depth counts from the eye, the oracle's t from the ray's anchor.
  const FoundHit found{aov.triangle, static_cast<double>(aov.normal_z.w) - ray.anchor_distance,
                       has_nan(frame.colors[pixel], aov)};
  return classify(found, truth.pixels[pixel], ray.ray.direction, radius);
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
    if (answer.hit) ++accuracy.hits;
    if (!answer.decidable) ++accuracy.undecidable;
    const ClassifiedRay ray = classify_pixel(frame, truth, i, params, scene.radius);
    switch (ray.verdict) {
      case RayVerdict::undecidable:
      case RayVerdict::both_miss:
        break;
      case RayVerdict::not_a_number:
        ++accuracy.nans;
        break;
      case RayVerdict::wrong_hit:
        ++accuracy.wrong_hits;
        break;
      case RayVerdict::missed:
        ++accuracy.missed;
        break;
      case RayVerdict::wrong_patch:
        ++accuracy.wrong_patches;
        break;
      case RayVerdict::hit:
      case RayVerdict::wrong_root:
        errors.add(ray, aov, answer.root);
        break;
    }
  }
  accuracy.off_surface = quantiles_of(std::move(errors.off_surface));
  accuracy.depth_ulp = quantiles_of(std::move(errors.depth_ulp));
  accuracy.normal_degrees = quantiles_of(std::move(errors.normal_degrees));
  accuracy.median_evaluations = quantiles_of(std::move(evaluations)).p50;
  return accuracy;
}

}  // namespace trisect
