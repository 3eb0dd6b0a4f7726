#include "tests/support/watertight.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/parallel_rows.h"
#include "app/dispatch/ray_caster.h"
#include "app/dispatch/trace_settings.h"
#include "app/oracle/oracle.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"

namespace trisect::test {
namespace {

using glm::dvec3;

struct AimedRay {
  CastRay ray;
  double target;  // distance to the point that it is aimed at; infinite from inside
};

class Aim {
 public:
  Aim(const BakedScene& scene, uint64_t seed) : scene_(scene), random_(seed) {}

  AimedRay next() {
    const Triangle& baked = scene_.triangles[random_() % scene_.triangles.size()];
    const in_double::Triangle tri = to_double(baked);
    const in_double::Shape shape = shape_of(scene_.choice);
    const dvec3 w = weights();
    const dvec3 point = in_double::surface_point(shape, tri, w);
    const dvec3 normal = in_double::geometric_normal(shape, tri, w);
    // Where the tangents are parallel there is no below.
    if (random_() % 2 == 0 || glm::any(glm::isnan(normal))) return from_outside(point);
    // A little below the surface, which no asset is thinner than.
    return from_inside(point - normal * (0.02 * scene_.radius));
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  // In a face, within 1e-6 of an edge, on an edge, at a vertex.
  dvec3 weights() {
    const double a = unit();
    const double b = unit();
    const int turn = static_cast<int>(random_() % 3);
    const dvec3 inside =
        a + b < 1.0 ? dvec3(1.0 - a - b, a, b) : dvec3(a + b - 1.0, 1.0 - a, 1.0 - b);
    const double off = 1e-6 * b;
    const std::array<dvec3, 4> kinds{inside, dvec3(off, a * (1.0 - off), (1.0 - a) * (1.0 - off)),
                                     dvec3(0.0, a, 1.0 - a), dvec3(0.0, 0.0, 1.0)};
    const dvec3 w = kinds[random_() % kinds.size()];
    return {w[turn], w[(turn + 1) % 3], w[(turn + 2) % 3]};
  }

  dvec3 direction() {
    std::normal_distribution<double> normal;
    return glm::normalize(dvec3(normal(random_), normal(random_), normal(random_)));
  }

  AimedRay from_outside(const dvec3& point) {
    // Rounded first: the ray is aimed from where it starts.
    const glm::vec3 origin(point + direction() * (scene_.radius * (2.0 + 2.0 * unit())));
    const dvec3 to_point = point - dvec3(origin);
    return {{vec4(origin, 0.0F), vec4(glm::vec3(glm::normalize(to_point)), 0.0F)},
            glm::length(to_point)};
  }

  AimedRay from_inside(const dvec3& point) {
    return {{vec4(glm::vec3(point), 0.0F), vec4(glm::vec3(direction()), 0.0F)},
            std::numeric_limits<double>::infinity()};
  }

  const BakedScene& scene_;
  std::mt19937_64 random_;
};

}  // namespace

Leaks count_leaks(const std::string& asset, uint32_t surface, std::size_t count, uint64_t seed) {
  BakedScene scene =
      bake_with_subpatches(without_holes(load_asset(asset)), {surface, 0.65, SHELL_NORMAL});
  scene.bvh = build_bvh(scene);
  const Oracle oracle(scene);
  RayCaster caster(validated_device(), scene, make_params(scene, {}), SOLVER_ROBUST);
  Aim aim(scene, seed);
  Leaks leaks;
  // A first hit may lie before the target, and behind it by some roundings; of others the oracle is
  // asked.
  const double behind = 1e-5 * scene.radius;
  constexpr std::size_t batch = 1U << 18U;
  while (leaks.rays < count) {
    std::vector<AimedRay> aimed(std::min(batch, count - leaks.rays));
    std::vector<CastRay> rays;
    for (AimedRay& one : aimed) {
      one = aim.next();
      rays.push_back(one.ray);
    }
    const std::vector<CastHit> hits = caster.cast(rays);
    std::vector<std::size_t> suspects;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const CastHit& hit = hits[i];
      if (!std::isfinite(hit.z) || !std::isfinite(hit.u) || !std::isfinite(hit.v)) ++leaks.nans;
      const double z = static_cast<double>(hit.z);
      if (hit.triangle == NO_TRIANGLE || z > aimed[i].target + behind) suspects.push_back(i);
    }
    leaks.suspects += suspects.size();
    std::atomic<std::size_t> undecided = 0;
    std::atomic<std::size_t> leaking = 0;
    parallel_chunks(suspects.size(), 64, [&](std::size_t first, std::size_t end) {
      for (std::size_t k = first; k < end; ++k) {
        const CastHit& hit = hits[suspects[k]];
        const CastRay& ray = rays[suspects[k]];
        const OracleRay asked{dvec3(ray.anchor), glm::normalize(dvec3(ray.direction))};
        const OracleAnswer answer = oracle.first(asked, 1e-7 * 4.0 * scene.radius);
        if (!answer.decidable) ++undecided;
        if (!answer.decidable || !answer.hit) continue;
        // Across the surface: a ray that grazes it turns a rounding sideways into far more along
        // itself.
        const double across = (static_cast<double>(hit.z) - answer.root.t) *
                              std::abs(glm::dot(answer.root.normal, asked.direction));
        if (hit.triangle == NO_TRIANGLE || across > 2e-6 * scene.radius) ++leaking;
      }
    });
    leaks.undecided += undecided;
    leaks.leaks += leaking;
    leaks.rays += aimed.size();
  }
  return leaks;
}

}  // namespace trisect::test
