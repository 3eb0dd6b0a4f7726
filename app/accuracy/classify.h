// The rules by which a solver's hit is judged against the oracle's answer for the same ray. All
// measurements of errors use these: frames, ray lists, reports and the viewer's error map.
#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "app/oracle/oracle.h"
#include "app/surface/shared.h"

namespace trisect {

// What a solver found along one ray.
struct FoundHit {
  uint triangle = NO_TRIANGLE;  // NO_TRIANGLE: the solver found no hit
  double depth = 0.0;           // along the unit ray, from where the oracle's t counts; if hit
  bool nan = false;             // whether any number that the solver returned is NaN
};

// A ray's hit as the solvers return it; z, u and v count as NaN if they are infinite, too.
FoundHit found_hit(const CastHit& hit);

// The first rule that applies decides, in this order.
enum class RayVerdict {
  // The solver returned a NaN, or the distance between the two hits is not finite. It comes first
  // because a NaN is a fault whatever the oracle says.
  not_a_number,
  // The oracle's answer flips when the ray moves by a rounding error of single precision, so no
  // answer of the solver can be held against it.
  undecidable,
  both_miss,
  wrong_hit,    // the solver hits, the oracle misses
  missed,       // the oracle hits, the solver misses
  hit,          // the same triangle, or a neighbour that ties with it
  wrong_patch,  // another triangle, farther off than a tie
  wrong_root    // the same triangle, so far off that it is another of its intersections
};

// Whether the solver and the oracle both hit, wherever that is: there is a distance between the
// hits.
bool both_hit(RayVerdict verdict);

// Two triangles meet in their common edge, and rounding decides which of them the solver reports
// there. Hits on different triangles that are at most this far apart, as a fraction of the scene's
// radius, are a tie. That is about ten roundings of single precision.
constexpr double kTie = 1e-6;

// A hit on the right triangle that is farther off than this, as a fraction of the scene's radius,
// is no inaccurate root but another one: behind a fold of the patch, or on its far side.
constexpr double kOtherRoot = 1e-2;

// The distance off the surface is the depth error times the sine of the angle between ray and
// surface, |n.d|. Where a ray grazes the surface that product is small however wrong the depth is,
// so the two rules above count a smaller sine as this one: an error of depth of more than a
// thousandth of the radius never ties.
constexpr double kLeastSlant = 1e-3;

struct ClassifiedRay {
  RayVerdict verdict = RayVerdict::both_miss;
  // Unless both_hit(verdict) there is no distance, and both stay NaN.
  // |depth error| |n.d|, n the oracle's normal, over the scene's radius:
  double off_surface = std::numeric_limits<double>::quiet_NaN();
  // |depth error|, in the scene's units:
  double depth_error = std::numeric_limits<double>::quiet_NaN();
};

// answer: the oracle's for this ray. direction: the ray's, of unit length. radius: the scene's, or
// another length that errors are to be measured in; positive. Safe to call from several threads.
ClassifiedRay classify(const FoundHit& found, const OracleAnswer& answer,
                       const glm::dvec3& direction, double radius);

}  // namespace trisect
