#include "tests/certify/pixel_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "app/surface/patch_range.h"

namespace trisect::test {
namespace {

using glm::dvec3;
using in_double::SubTriangle;

using Key = std::tuple<double, double, double>;
Key key_of(const SubTriangle& piece) {
  return {piece.origin.y, piece.origin.z, piece.size};
}

// Whether these sub-triangles, and those that they are made of, make up the piece.
bool is_covered(const SubTriangle& piece, const std::set<Key>& by) {
  if (by.count(key_of(piece)) > 0) return true;
  // The search divides twelve times at most.
  if (std::abs(piece.size) < 1.0 / 8192.0) return false;
  const auto children = quarter(piece);
  return std::all_of(children.begin(), children.end(),
                     [&](const SubTriangle& child) { return is_covered(child, by); });
}

// Whether the rays may come into a patch's ball.
bool may_be_met(const Triangle& tri, const RayTube& tube) {
  const dvec3 x = dvec3(tri.Domain) - tube.origin;
  const double along = glm::dot(x, tube.direction);
  const double reach = static_cast<double>(tri.Domain.w) + 1.42 * tube.radius;
  const double beside = glm::length(x - tube.direction * along);
  if (!has_surface(tri) || beside > reach) return false;
  return along + std::sqrt(reach * reach - beside * beside) >= tube.t_min - tube.radius;
}

// The least weight that a root may have, within a sub-triangle or, of the whole one, the patch.
double least_weight(const Certificate& root, const SubTriangle& piece) {
  const dvec3 l = in_double::weights_in(piece, root.weights);
  const double reach = root.weight_radius / std::abs(piece.size);
  return std::min({l.x - 2.0 * reach, l.y - reach, l.z - reach});
}

bool is_off_its_core(const Certificate& root) {
  const dvec3 l = in_double::weights_in(root.core, root.weights);
  const double reach = root.weight_radius / std::abs(root.core.size);
  return l.x + 2.0 * reach < 0.0 || l.y + reach < 0.0 || l.z + reach < 0.0;
}

bool is_same(const Certificate& a, const Certificate& b) {
  return a.triangle == b.triangle &&
         (least_weight(a, b.piece) > 0.0 || least_weight(b, a.piece) > 0.0);
}

}  // namespace

std::string gap_in(const std::vector<Certificate>& certificates, const CertifiedAnswer& answer,
                   const RayTube& tube, const std::vector<Triangle>& triangles) {
  std::map<uint32_t, std::set<Key>> dealt_with;
  std::vector<Certificate> roots;
  std::vector<Certificate> on_borders;  // which the patch may have or not
  for (const Certificate& certificate : certificates) {
    dealt_with[certificate.triangle].insert(key_of(certificate.core));
    if (certificate.kind != CertificateKind::one_root) continue;
    if (is_off_its_core(certificate) || certificate.t.hi < tube.t_min - tube.radius) continue;
    const bool is_inside = least_weight(certificate, kWholeTriangle) > 0.0;
    (is_inside ? roots : on_borders).push_back(certificate);
  }
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    if (may_be_met(triangles[i], tube) && !is_covered(kWholeTriangle, dealt_with[i])) {
      return fmt::format("a part of triangle {} is not dealt with", i);
    }
  }
  double behind = -kInfinity;  // what lies beyond this lies behind the answer
  if (answer.reason == Reason::one_root) {
    const auto first = std::find_if(roots.begin(), roots.end(), [&](const Certificate& root) {
      return root.triangle == answer.root.triangle && root.t.lo == answer.t.lo &&
             root.t.hi == answer.t.hi;
    });
    if (first == roots.end()) return "the answer's root is none";
    if (!(first->t.lo > tube.t_min + tube.radius)) return "the rays may begin behind the root";
    behind = first->t.hi;
    for (const Certificate& root : roots) {
      if (is_same(root, *first)) {
        behind = std::min(behind, root.t.hi);
      } else if (!(root.t.lo > first->t.hi)) {
        return "another root may be nearer";
      }
    }
    for (const Certificate& root : on_borders) {
      if (!(root.t.lo > first->t.hi)) return "a root on a border may be nearer";
    }
  } else if (!roots.empty() || !on_borders.empty()) {
    return "there is a root";
  }
  for (const Certificate& certificate : certificates) {
    if (certificate.kind != CertificateKind::behind) continue;
    if (answer.reason != Reason::one_root) return "there is nothing to lie behind";
    if (!(certificate.t.lo >= behind)) return "what is left out may be nearer";
  }
  return "";
}

}  // namespace trisect::test
