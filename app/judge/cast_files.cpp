#include "app/judge/cast_files.h"

#include <algorithm>
#include <cmath>

#include "app/base/parallel_rows.h"
#include "app/base/rounding.h"

namespace trisect {
namespace {

using glm::dvec3;

// A ray as kernels take it, and where its t is 0: z = along + t length.
struct MovedRay {
  CastRay cast;
  double along;
  double length;
};

// The anchor is the ray's nearest point to the scene's origin, where single precision has most
// digits.
MovedRay moved_ray(const BakedScene& scene, const FileRay& ray) {
  const double length = glm::length(ray.direction);
  const dvec3 direction = ray.direction / length;
  const dvec3 origin = ray.origin - scene.origin;
  const double along = glm::dot(origin, direction);
  const dvec3 anchor = origin - direction * along;
  const float begins = rounded_up(along + ray.t_min * length);
  return {{vec4(glm::vec3(anchor), begins), vec4(glm::vec3(direction), 0.0F)}, along, length};
}

FileHit file_hit(const MovedRay& moved, const FileRay& ray, const CastHit& hit) {
  FileHit found;
  if (hit.triangle == NO_TRIANGLE) return found;
  found.t = (static_cast<double>(hit.z) - moved.along) / moved.length;
  if (found.t > ray.t_max) return {};
  found.u = hit.u;
  found.v = hit.v;
  found.triangle = hit.triangle;
  return found;
}

}  // namespace

OracleRay to_oracle_ray(const BakedScene& scene, const FileRay& ray) {
  const double length = glm::length(ray.direction);
  return {ray.origin - scene.origin, ray.direction / length, ray.t_min * length,
          ray.t_max * length};
}

std::optional<std::vector<FileHit>> cast_file_rays(const BakedScene& scene,
                                                   std::span<const FileRay> rays,
                                                   const Caster& caster, const Progress& progress) {
  constexpr std::size_t most = 16384;  // at a time: some tenths of a second
  std::vector<FileHit> hits;
  hits.reserve(rays.size());
  std::vector<MovedRay> moved;
  std::vector<CastRay> casts;
  while (hits.size() < rays.size()) {
    const auto part = rays.subspan(hits.size(), std::min(most, rays.size() - hits.size()));
    moved.clear();
    casts.clear();
    for (const FileRay& ray : part) {
      moved.push_back(moved_ray(scene, ray));
      casts.push_back(moved.back().cast);
    }
    const std::vector<CastHit> found = caster(casts);
    for (std::size_t i = 0; i < part.size(); ++i) {
      hits.push_back(file_hit(moved[i], part[i], found[i]));
    }
    if (progress && !progress(static_cast<uint32_t>(hits.size()))) return std::nullopt;
  }
  return hits;
}

std::optional<std::vector<FileHit>> cast_by_oracle(const BakedScene& scene,
                                                   std::span<const FileRay> rays,
                                                   const Progress& progress) {
  const Oracle oracle(scene);
  std::vector<FileHit> hits(rays.size());
  const auto cast = [&](uint32_t i) {
    const std::vector<OracleRoot> roots = oracle.roots(to_oracle_ray(scene, rays[i]));
    if (roots.empty()) return;
    const OracleRoot& root = roots.front();
    hits[i] = {root.t / glm::length(rays[i].direction), root.weights.y, root.weights.z,
               root.triangle};
  };
  if (!parallel_rows(static_cast<uint32_t>(rays.size()), cast, progress)) return std::nullopt;
  return hits;
}

}  // namespace trisect
