#include "app/certify/certifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/memory.h"
#include "app/base/parallel_rows.h"
#include "app/oracle/oracle_tracer.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec3;

// Divisions of each patch whose enclosures are kept in memory: 85 of 0.4 kilobytes, and as much
// again for the sphere surface; fewer if there are very many patches.
int kept_divisions(std::size_t patches) {
  if (patches <= 10000) return 3;
  return patches <= 100000 ? 1 : 0;
}

// Whether two roots of a patch are one: the region of one of them, in the weights 1 and 2, lies in
// the piece of the other, which holds a single root.
bool is_same(const TubeFindings::Root& a, const TubeFindings::Root& b) {
  const auto holds = [](const in_double::SubTriangle& piece, const TubeFindings::Root& root) {
    const dvec3 l = in_double::weights_in(piece, root.weights);
    const double reach = root.weight_radius / std::abs(piece.size) + kWithinSlack;
    return l.x - 2.0 * reach > 0.0 && l.y - reach > 0.0 && l.z - reach > 0.0;
  };
  return a.triangle == b.triangle && (holds(a.piece, b) || holds(b.piece, a));
}

Reason reason_of(Doubt doubt) {
  switch (doubt) {
    case Doubt::border:
      return Reason::border;
    case Doubt::fold:
      return Reason::fold;
    default:
      return Reason::nonsmooth;
  }
}

// The reason, and the root if it is one_root.
std::pair<Reason, const TubeFindings::Root*> conclusion(const TubeFindings& findings,
                                                        const RayTube& tube) {
  const TubeFindings::Root* first = nullptr;
  for (const TubeFindings::Root& root : findings.roots) {
    if (first == nullptr || root.t.lo < first->t.lo) first = &root;
  }
  const TubeFindings::Open* open = nullptr;
  for (const TubeFindings::Open& other : findings.open) {
    if (open == nullptr || other.t < open->t) open = &other;
  }
  if (open != nullptr && (first == nullptr || !(open->t > first->t.hi))) {
    return {reason_of(open->doubt), nullptr};
  }
  if (first == nullptr) {
    return {findings.used_tangents ? Reason::contraction : Reason::hulls, nullptr};
  }
  if (!(first->t.lo > tube.t_min + tube.radius)) return {Reason::ray_start, nullptr};
  for (const TubeFindings::Root& root : findings.roots) {
    if (&root != first && root.t.lo <= first->t.hi && !is_same(root, *first)) {
      return {Reason::order, nullptr};
    }
  }
  return {Reason::one_root, first};
}

}  // namespace

RayTube tube_around(const OracleRay& ray, double radius) {
  const Line line = line_along(ray.origin, ray.direction);
  return {ray.origin, ray.direction, {line.across[0], line.across[1]}, ray.t_min, radius};
}

Certifier::Certifier(const BakedScene& scene) : Certifier(scene, Progress{}) {}

std::optional<Certifier> Certifier::make(const BakedScene& scene, const Progress& progress) {
  Certifier certifier(scene, progress);
  if (!certifier.is_whole_) return std::nullopt;
  return certifier;
}

Certifier::Certifier(const BakedScene& scene, const Progress& progress)
    : choice_(with_single_alpha(scene.choice)), triangles_(scene.triangles) {
  const int divisions = kept_divisions(triangles_.size());
  expect_memory(
      static_cast<double>(triangles_.size()) * PatchCertifier::bytes_of(choice_, divisions),
      fmt::format("the enclosures of {} patches", triangles_.size()));
  patches_.resize(triangles_.size());
  const auto enclose = [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      patches_[i] = PatchCertifier(choice_, triangles_[i], static_cast<uint32_t>(i), divisions);
    }
  };
  // They take up to some milliseconds each.
  constexpr std::size_t chunk = 16;
  is_whole_ = parallel_chunks(triangles_.size(), chunk, enclose, progress);
  std::vector<Box> boxes;
  boxes.reserve(triangles_.size());
  for (const Triangle& tri : triangles_) boxes.push_back(box_around_ball(glm::dvec4(tri.Domain)));
  tree_ = BoxTree(boxes);
}

CertifiedAnswer Certifier::first(const OracleRay& ray, double radius,
                                 std::vector<Certificate>* certificates) const {
  thread_local std::vector<uint32_t> candidates;
  thread_local TubeFindings findings;
  const RayTube tube = tube_around(ray, radius);
  // The tube is a square: its edges are farther off than its sides.
  const double margin = 1.5 * radius;
  tree_.meet(ray.origin, ray.direction, ray.t_min - margin, kInfinity, margin, candidates);
  CertifiedAnswer answer;
  if (candidates.empty()) return answer;
  // The nearest first, so that less of the others is looked at.
  std::sort(candidates.begin(), candidates.end(), [&](uint32_t a, uint32_t b) {
    const auto nearest = [&](uint32_t i) {
      const dvec3 center(triangles_[i].Domain);
      return glm::dot(center, ray.direction) - static_cast<double>(triangles_[i].Domain.w);
    };
    return std::pair(nearest(a), a) < std::pair(nearest(b), b);
  });
  findings.clear();
  findings.certificates = certificates;
  for (const uint32_t triangle : candidates) patches_[triangle].search(tube, findings);
  const auto [reason, root] = conclusion(findings, tube);
  answer.reason = reason;
  if (root != nullptr) {
    const in_double::Triangle tri = to_double(triangles_[root->triangle]);
    answer.t = root->t;
    answer.root = {middle(root->t), root->triangle, root->weights,
                   in_double::geometric_normal(shape_of(choice_), tri, root->weights)};
  }
  return answer;
}

std::optional<CertifiedFrame> certify_frame(const Certifier& certifier, const TraceParams& params,
                                            const Progress& progress) {
  CertifiedFrame frame{params.width, params.height, {}};
  const std::size_t pixels = std::size_t{params.width} * params.height;
  expect_memory(static_cast<double>(pixels) * sizeof(CertifiedAnswer),
                fmt::format("the proofs of {}x{} pixels", params.width, params.height));
  frame.pixels.resize(pixels);
  const double radius = kMotion * static_cast<double>(params.anchor.w);
  const auto row = [&](uint32_t y, const Stopped& stopped) {
    for (uint32_t x = 0; x < params.width && !stopped; ++x) {
      frame.pixels[std::size_t{y} * params.width + x] =
          certifier.first(oracle_pixel_ray(params, x, y).ray, radius);
    }
  };
  if (!parallel_rows(params.height, row, progress)) return std::nullopt;
  return frame;
}

}  // namespace trisect
