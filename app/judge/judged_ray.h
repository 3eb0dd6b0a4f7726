// The hits that any ray tracer has found for given rays, judged by the oracle.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "app/accuracy/classify.h"
#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/base/quantiles.h"
#include "app/judge/ray_file.h"

namespace trisect {

// Of far rays a unit in the last place of t is more than kTie: hits on different triangles whose t
// are no more of these apart are a tie, too.
constexpr double kTieUlps = 1.0;

// Where in its triangle a root is: whether one of its weights is less than this, or two.
constexpr double kNearBorder = 1e-3;
enum class RootPlace { inside, edge, vertex };
RootPlace root_place_of(const glm::dvec3& weights);

struct JudgedRay {
  RayVerdict verdict = RayVerdict::both_miss;
  FileHit truth;                        // the first root, of double precision
  RootPlace place = RootPlace::inside;  // of that root
  // NaN unless both_hit(verdict): the distance between the two along the ray, in the model's units;
  // across the surface, over the model's radius (classify); |t - t'| in units of the last place of
  // t' in single precision.
  double length = std::numeric_limits<double>::quiet_NaN();
  double across = std::numeric_limits<double>::quiet_NaN();
  double ulp = std::numeric_limits<double>::quiet_NaN();
  // The larger error of u and v, where both are of one triangle and told.
  double weight = std::numeric_limits<double>::quiet_NaN();
};

// One for each ray, computed on all cores. scene: baked about the origin of the model's
// coordinates, for that is where the rays are (bake_about). A ray is undecidable if the first root
// is another one, or none, when the ray is moved by one part in 1e7 of the larger of the model's
// radius and the distance of the ray's origin from the middle of the model. progress counts rays;
// nothing is returned if it stops the work. Throws std::invalid_argument unless there is a hit for
// each ray, and std::out_of_range if one names a triangle that is not there.
std::optional<std::vector<JudgedRay>> judged_rays(const BakedScene& scene,
                                                  std::span<const FileRay> rays,
                                                  std::span<const FileHit> hits,
                                                  const Progress& progress);

// The same, summed up.
struct Judgement {
  std::size_t rays = 0;
  std::size_t undecidable = 0;
  std::size_t hits = 0;    // right ones
  std::size_t misses = 0;  // right ones
  // Wrong: the ray hits, and no hit was found; it does not, and one was; another triangle, farther
  // off than a tie; another root of the same triangle; a NaN.
  std::size_t missed = 0;
  std::size_t invented = 0;
  std::size_t wrong_patch = 0;
  std::size_t wrong_root = 0;
  std::size_t nans = 0;
  // Of those that missed the root or found another one, where the root is.
  std::size_t at_edge = 0;
  std::size_t at_vertex = 0;
  // Of the right hits.
  Quantiles length;
  Quantiles across;
  Quantiles ulp;
  Quantiles weight;

  [[nodiscard]] std::size_t wrong() const {
    return missed + invented + wrong_patch + wrong_root + nans;
  }
};
Judgement sum_of(std::span<const JudgedRay> rays);

}  // namespace trisect
