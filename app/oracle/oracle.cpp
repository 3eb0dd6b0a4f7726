#include "app/oracle/oracle.h"

#include <algorithm>
#include <cmath>

#include "app/base/interval.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec3;

// Levels of each patch's quadtree that are kept in memory: 85 nodes of 0.8 kilobytes, fewer if
// there are very many patches.
int kept_levels(std::size_t patches) {
  if (patches <= 3000) return 3;
  return patches <= 30000 ? 2 : 1;
}

bool earlier(const OracleRoot& a, const OracleRoot& b) {
  return a.t < b.t;
}

void keep_between(double t_min, double t_max, std::vector<OracleRoot>& roots) {
  std::erase_if(roots,
                [&](const OracleRoot& root) { return !(root.t >= t_min && root.t <= t_max); });
}

void append(uint32_t triangle, const PatchFindings& findings, std::vector<OracleRoot>& roots) {
  for (const PatchFindings::Root& root : findings.roots) {
    roots.push_back({root.t, triangle, root.weights, root.normal});
  }
}

double slant(const OracleRay& ray, const OracleRoot& root) {
  return std::abs(glm::dot(ray.direction, root.normal));
}

// Whether the answers for a ray and for the moved ray agree. On a plane t changes by the motion
// over the sine of the angle between ray and plane; 50 times that leaves room for the surface's
// curvature. The triangle does not matter: across a shared edge t is the same, across a gap it
// jumps.
bool same(const OracleRay& ray, const OracleAnswer& a, const OracleAnswer& b, double motion) {
  if (a.hit != b.hit) return false;
  if (!a.hit) return true;
  const double sine = std::max({slant(ray, a.root), slant(ray, b.root), motion});
  return std::abs(a.root.t - b.root.t) <= 50.0 * motion / sine;
}

OracleAnswer answer_of(const std::vector<OracleRoot>& roots, double t_min, double t_max) {
  OracleAnswer answer;
  for (const OracleRoot& root : roots) {
    if (root.t < t_min || root.t > t_max) continue;
    answer.hit = true;
    answer.root = root;
    break;
  }
  return answer;
}

}  // namespace

struct Oracle::Search {
  std::vector<OracleRoot> roots;  // sorted by t; some lie beyond the ray's ends
  double doubt_t = kInfinity;     // PatchFindings::doubt_t
};

Oracle::Oracle(const BakedScene& scene) {
  std::vector<Box> boxes;
  boxes.reserve(scene.triangles.size());
  patches_.reserve(scene.triangles.size());
  const int levels = kept_levels(scene.triangles.size());
  const SurfaceChoice choice = with_single_alpha(scene.choice);
  for (const Triangle& tri : scene.triangles) {
    // Of the patch's ball. Where there is no surface it is that of the flat triangle's: a search
    // finds nothing in it.
    boxes.push_back(box_around_ball(glm::dvec4(tri.Domain)));
    patches_.emplace_back(choice, tri, levels);
  }
  tree_ = BoxTree(boxes);
}

// All roots between the ray's ends and within the margin of them.
Oracle::Search Oracle::search(const OracleRay& ray, double margin) const {
  thread_local std::vector<uint32_t> candidates;
  const double t_min = ray.t_min - margin;
  const double t_max = ray.t_max + margin;
  tree_.meet(ray.origin, ray.direction, t_min, t_max, margin, candidates);
  const Line line = line_along(ray.origin, ray.direction);
  PatchFindings findings(margin);
  Search found;
  for (const uint32_t triangle : candidates) {
    findings.clear();
    patches_[triangle].roots(line, t_min, t_max, findings);
    append(triangle, findings, found.roots);
    found.doubt_t = std::min(found.doubt_t, findings.doubt_t);
  }
  std::stable_sort(found.roots.begin(), found.roots.end(), earlier);
  return found;
}

std::vector<OracleRoot> Oracle::roots_of(uint32_t triangle, const OracleRay& ray) const {
  PatchFindings findings(0.0);
  findings.clear();
  patches_.at(triangle).roots(line_along(ray.origin, ray.direction), ray.t_min, ray.t_max,
                              findings);
  std::vector<OracleRoot> roots;
  append(triangle, findings, roots);
  keep_between(ray.t_min, ray.t_max, roots);
  std::sort(roots.begin(), roots.end(), earlier);
  return roots;
}

std::vector<OracleRoot> Oracle::roots(const OracleRay& ray) const {
  Search found = search(ray, 0.0);
  keep_between(ray.t_min, ray.t_max, found.roots);
  return std::move(found.roots);
}

OracleAnswer Oracle::first(const OracleRay& ray, double motion) const {
  const Search found = search(ray, 2.0 * motion);
  OracleAnswer answer = answer_of(found.roots, ray.t_min, ray.t_max);
  if (suspicious(ray, found, motion)) {
    answer.decidable = !passes_vertex(ray, answer, motion) && survives_motion(ray, answer, motion);
  }
  return answer;
}

bool Oracle::suspicious(const OracleRay& ray, const Search& found, double motion) const {
  constexpr double near_border = 1e-3;      // weight
  constexpr double near_silhouette = 0.05;  // sine
  const double near_end = 10.0 * motion;
  double first_t = kInfinity;
  for (const OracleRoot& root : found.roots) {
    if (std::abs(root.t - ray.t_min) <= near_end || std::abs(root.t - ray.t_max) <= near_end) {
      return true;
    }
    if (root.t < ray.t_min || root.t > ray.t_max) continue;
    const double border =
        std::max(near_border, 10.0 * motion / patches_[root.triangle].longest_edge());
    const double weight = std::min({root.weights.x, root.weights.y, root.weights.z});
    first_t = root.t;
    if (weight < border || slant(ray, root) < near_silhouette) return true;
    break;
  }
  return found.doubt_t <= first_t + near_end;
}

// Whether a vertex that the ray passes by less than the motion lies before the answer: moved there
// the ray meets it. A sharp corner may lie between the directions in which survives_motion() moves.
bool Oracle::passes_vertex(const OracleRay& ray, const OracleAnswer& answer, double motion) const {
  const double t_min = ray.t_min - 2.0 * motion;
  const double t_max = ray.t_max + 2.0 * motion;
  const double before =
      answer.hit ? answer.root.t - 50.0 * motion / std::max(slant(ray, answer.root), motion)
                 : kInfinity;
  std::vector<uint32_t> candidates;
  tree_.meet(ray.origin, ray.direction, t_min, t_max, motion, candidates);
  const Line line = line_along(ray.origin, ray.direction);
  return std::any_of(candidates.begin(), candidates.end(), [&](uint32_t triangle) {
    return patches_[triangle].first_vertex(line, t_min, t_max, motion) < before;
  });
}

bool Oracle::survives_motion(const OracleRay& ray, const OracleAnswer& answer,
                             double motion) const {
  for (const dvec3& axis : line_along(ray.origin, ray.direction).across) {
    for (const double sign : {-1.0, 1.0}) {
      OracleRay moved = ray;
      moved.origin += axis * (sign * motion);
      const Search found = search(moved, 0.0);
      if (!same(ray, answer, answer_of(found.roots, ray.t_min, ray.t_max), motion)) return false;
    }
  }
  const Search found = search(ray, motion);
  for (const double m : {-motion, motion}) {
    const OracleAnswer moved = answer_of(found.roots, ray.t_min + m, ray.t_max - m);
    if (!same(ray, answer, moved, motion)) return false;
  }
  return true;
}

}  // namespace trisect
