#include "app/accuracy/classify.h"

#include <algorithm>
#include <cmath>

namespace trisect {
namespace {

ClassifiedRay classify_hits(const FoundHit& found, const OracleRoot& root,
                            const glm::dvec3& direction, double radius) {
  const double depth_error = std::abs(found.depth - root.t);
  const double slant = std::abs(glm::dot(root.normal, direction));
  const double off_surface = depth_error * slant / radius;
  if (!std::isfinite(off_surface)) return ClassifiedRay{RayVerdict::not_a_number};
  const double counted = depth_error * std::max(slant, kLeastSlant) / radius;
  RayVerdict verdict = RayVerdict::hit;
  if (found.triangle == root.triangle) {
    if (counted > kOtherRoot) verdict = RayVerdict::wrong_root;
  } else if (counted > kTie) {
    verdict = RayVerdict::wrong_patch;
  }
  return {verdict, off_surface, depth_error};
}

}  // namespace

FoundHit found_hit(const CastHit& hit) {
  const bool finite = std::isfinite(hit.z) && std::isfinite(hit.u) && std::isfinite(hit.v);
  return {hit.triangle, static_cast<double>(hit.z), !finite};
}

bool both_hit(RayVerdict verdict) {
  return verdict == RayVerdict::hit || verdict == RayVerdict::wrong_patch ||
         verdict == RayVerdict::wrong_root;
}

ClassifiedRay classify(const FoundHit& found, const OracleAnswer& answer,
                       const glm::dvec3& direction, double radius) {
  if (found.nan) return ClassifiedRay{RayVerdict::not_a_number};
  if (!answer.decidable) return ClassifiedRay{RayVerdict::undecidable};
  const bool hit = found.triangle != NO_TRIANGLE;
  if (!hit && !answer.hit) return ClassifiedRay{RayVerdict::both_miss};
  if (!answer.hit) return ClassifiedRay{RayVerdict::wrong_hit};
  if (!hit) return ClassifiedRay{RayVerdict::missed};
  return classify_hits(found, answer.root, direction, radius);
}

}  // namespace trisect
