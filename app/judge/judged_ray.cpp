#include "app/judge/judged_ray.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/base/parallel_rows.h"
#include "app/base/ulp.h"
#include "app/judge/cast_files.h"
#include "app/oracle/oracle.h"

namespace trisect {
namespace {

using glm::dvec3;

FoundHit found_hit(const FileHit& hit, double length, const OracleAnswer& answer) {
  // A triangle that is not told is the right one.
  const uint triangle =
      hit.triangle == kSomeTriangle && answer.hit ? answer.root.triangle : hit.triangle;
  const bool is_hit = hit.triangle != NO_TRIANGLE;
  return {triangle, hit.t * length, is_hit && !std::isfinite(hit.t)};
}

JudgedRay judged_ray(const FileRay& ray, const FileHit& hit, const OracleAnswer& answer,
                     double radius) {
  const double length = glm::length(ray.direction);
  JudgedRay judged;
  if (answer.hit) {
    const OracleRoot& root = answer.root;
    judged.truth = {root.t / length, root.weights.y, root.weights.z, root.triangle};
    judged.place = root_place_of(root.weights);
  }
  const ClassifiedRay classified =
      classify(found_hit(hit, length, answer), answer, ray.direction / length, radius);
  judged.verdict = classified.verdict;
  if (!both_hit(judged.verdict)) return judged;
  judged.length = classified.depth_error;
  judged.across = classified.off_surface;
  judged.ulp = std::abs(hit.t - judged.truth.t) / ulp_of(judged.truth.t);
  if (judged.verdict == RayVerdict::wrong_patch && judged.ulp <= kTieUlps) {
    judged.verdict = RayVerdict::hit;
  }
  if (hit.triangle == judged.truth.triangle) {
    judged.weight = std::max(std::abs(hit.u - judged.truth.u), std::abs(hit.v - judged.truth.v));
  }
  return judged;
}

}  // namespace

RootPlace root_place_of(const dvec3& weights) {
  const int near = (weights.x < kNearBorder ? 1 : 0) + (weights.y < kNearBorder ? 1 : 0) +
                   (weights.z < kNearBorder ? 1 : 0);
  return near == 0 ? RootPlace::inside : near == 1 ? RootPlace::edge : RootPlace::vertex;
}

std::optional<std::vector<JudgedRay>> judged_rays(const BakedScene& scene,
                                                  std::span<const FileRay> rays,
                                                  std::span<const FileHit> hits,
                                                  const Progress& progress) {
  if (rays.size() != hits.size()) throw std::invalid_argument("there is not a hit for each ray");
  for (const FileHit& hit : hits) {
    if (hit.triangle < kSomeTriangle) static_cast<void>(scene.triangles.at(hit.triangle));
  }
  const Oracle oracle(scene);
  const dvec3 middle = scene.origin + scene.middle;
  std::vector<JudgedRay> judged(rays.size());
  const bool is_whole = parallel_rows(
      static_cast<uint32_t>(rays.size()),
      [&](uint32_t i) {
        const double size = std::max(scene.extent, glm::distance(rays[i].origin, middle));
        const OracleAnswer answer = oracle.first(to_oracle_ray(scene, rays[i]), 1e-7 * size);
        judged[i] = judged_ray(rays[i], hits[i], answer, scene.extent);
      },
      progress);
  if (!is_whole) return std::nullopt;
  return judged;
}

Judgement sum_of(std::span<const JudgedRay> rays) {
  Judgement sum;
  sum.rays = rays.size();
  std::vector<double> length;
  std::vector<double> across;
  std::vector<double> ulp;
  std::vector<double> weight;
  for (const JudgedRay& ray : rays) {
    switch (ray.verdict) {
      case RayVerdict::undecidable:
        ++sum.undecidable;
        break;
      case RayVerdict::both_miss:
        ++sum.misses;
        break;
      case RayVerdict::not_a_number:
        ++sum.nans;
        break;
      case RayVerdict::wrong_hit:
        ++sum.invented;
        break;
      case RayVerdict::missed:
        ++sum.missed;
        break;
      case RayVerdict::wrong_patch:
        ++sum.wrong_patch;
        break;
      case RayVerdict::wrong_root:
        ++sum.wrong_root;
        break;
      case RayVerdict::hit:
        ++sum.hits;
        length.push_back(ray.length);
        across.push_back(ray.across);
        ulp.push_back(ray.ulp);
        if (!std::isnan(ray.weight)) weight.push_back(ray.weight);
        break;
    }
    const bool lost = ray.verdict == RayVerdict::missed || ray.verdict == RayVerdict::wrong_patch ||
                      ray.verdict == RayVerdict::wrong_root;
    if (lost && ray.place == RootPlace::edge) ++sum.at_edge;
    if (lost && ray.place == RootPlace::vertex) ++sum.at_vertex;
  }
  sum.length = quantiles_of(std::move(length));
  sum.across = quantiles_of(std::move(across));
  sum.ulp = quantiles_of(std::move(ulp));
  sum.weight = quantiles_of(std::move(weight));
  return sum;
}

}  // namespace trisect
