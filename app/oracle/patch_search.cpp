#include "app/oracle/patch_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/base/interval.h"
#include "app/surface/tangent_range.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec2;
using glm::dvec3;

// At this depth, where edges have a 4096th of the patch's, a sub-triangle is not divided further
// even if it folds or Newton's iteration finds nothing.
constexpr int kDeepest = 12;
// Nor is one from this depth on whose enclosure is much larger than itself.
constexpr int kTornDepth = 7;
// A root may lie outside the triangle by this weight, so that rounding loses none on a shared edge.
constexpr double kOutside = 1e-12;
// A root's distance from the line, over the largest coordinate seen from the line's origin: some
// hundred roundings.
constexpr double kResidual = 1e-13;
// Relative, of a tangent: more than a hundred roundings.
constexpr double kTangentRounding = 1e-12;

double least(const dvec3& w) {
  return std::min({w.x, w.y, w.z});
}

double half_width(const Interval& a) {
  return (a.hi - a.lo) * 0.5;
}

// Whether two iterations ended at one root. Near a fold, a double root, Newton's iterates have half
// of their digits only, so roots that see the same side of the surface may be farther apart.
bool same_root(const PatchFindings::Root& a, const PatchFindings::Root& b, const dvec3& direction) {
  const bool same_side =
      (glm::dot(a.normal, direction) < 0.0) == (glm::dot(b.normal, direction) < 0.0);
  return glm::distance(a.weights, b.weights) < (same_side ? 1e-6 : 1e-9);
}

// A root beside the patch is none, but the surface comes near the line there.
void record(const PatchFindings::Root& root, const Line& line, PatchFindings& findings) {
  if (least(root.weights) < -kOutside) {
    findings.doubt_t = std::min(findings.doubt_t, root.t);
    return;
  }
  for (const PatchFindings::Root& known : findings.roots) {
    if (same_root(known, root, line.direction)) return;
  }
  findings.roots.push_back(root);
}

}  // namespace

void PatchFindings::clear() {
  roots.clear();
  doubt_t = kInfinity;
}

Line line_along(const dvec3& origin, const dvec3& direction) {
  const dvec3 helper = std::abs(direction.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
  const dvec3 first = glm::normalize(glm::cross(direction, helper));
  return {origin, direction, {first, glm::cross(direction, first)}};
}

struct PatchSearch::Query {
  const Line& line;
  double t_min;
  double t_max;
  double residual;  // a root's distance from the line at most
};

PatchSearch::PatchSearch(const SurfaceChoice& choice, const Triangle& tri, int levels)
    : choice_(choice),
      patch_(patch_of(choice.shell, tri)),
      shape_(shape_of(choice)),
      tri_(to_double(tri)),
      defined_(has_surface(tri)) {
  if (!defined_) return;
  nodes_.push_back(node_of(kWholeTriangle));
  std::size_t first = 0;
  for (int level = 0; level < levels; ++level) {
    const std::size_t last = nodes_.size();
    for (; first < last; ++first) {
      for (const in_double::SubTriangle& below : quarter(nodes_[first].sub_triangle)) {
        nodes_.push_back(node_of(below));
      }
    }
  }
}

PatchSearch::Point PatchSearch::evaluate(const dvec3& w) const {
  const in_double::Displacement sigma = in_double::displacement_and_derivatives(shape_, tri_, w);
  const dvec3 D = weigh(w, patch_.D);
  const dvec3 T = weigh(w, patch_.P);
  return {T + D * sigma.s,
          patch_.P[1] - patch_.P[0] + D * sigma.u + (patch_.D[1] - patch_.D[0]) * sigma.s,
          patch_.P[2] - patch_.P[0] + D * sigma.v + (patch_.D[2] - patch_.D[0]) * sigma.s};
}

PatchSearch::Node PatchSearch::node_of(const in_double::SubTriangle& sub_triangle) const {
  Node node{};
  node.sub_triangle = sub_triangle;
  node.enclosure = enclose(choice_, patch_, sub_triangle);
  node.tangents = tangents_of(sub_triangle);
  // For the other surfaces enclose() is of second order in the size already.
  if (choice_.surface == SURFACE_SPHERE && node.tangents) {
    node.tangent_enclosure = enclose_by_tangents(sub_triangle, *node.tangents);
  }
  return node;
}

std::optional<PatchSearch::Tangents> PatchSearch::tangents_of(
    const in_double::SubTriangle& sub_triangle) const {
  const std::optional<TangentRanges> ranges =
      tangent_ranges(choice_, patch_, sub_triangle,
                     {dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(0.0, 0.0, 1.0)});
  if (!ranges) return std::nullopt;
  Tangents tangents{};
  // By the weights of the patch, of which those within are this part.
  const double size = sub_triangle.size;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<glm::length_t>(k);
    tangents.S_u[axis] = middle(ranges->u[k]) / size;
    tangents.S_v[axis] = middle(ranges->v[k]) / size;
    tangents.off_u[axis] = half_width(ranges->u[k]) / std::abs(size);
    tangents.off_v[axis] = half_width(ranges->v[k]) / std::abs(size);
  }
  return tangents;
}

// S(w) = S(c) + a du + b dv, c the centre, a and b among the S_u and S_v between c and w.
Enclosure PatchSearch::enclose_by_tangents(const in_double::SubTriangle& sub_triangle,
                                           const Tangents& tangents) const {
  const CornerWeights weights = corner_weights(sub_triangle);
  const dvec3 center = in_double::centre_of(sub_triangle);
  const dvec3 S = in_double::surface_point(shape_, tri_, center);
  Enclosure e{};
  e.count = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec3 d = weights[k] - center;
    e.points[k] = S + tangents.S_u * d.y + tangents.S_v * d.z;
    e.radius = std::max(
        e.radius, glm::length(tangents.off_u * std::abs(d.y) + tangents.off_v * std::abs(d.z)));
  }
  e.radius += kTangentRounding * (glm::length(S) + patch_.longest);
  return e;
}

void PatchSearch::roots(const Line& line, double t_min, double t_max,
                        PatchFindings& findings) const {
  if (!defined_) return;
  double scale = glm::length(line.origin) + patch_.longest;
  for (const dvec3& p : patch_.P) scale = std::max(scale, glm::distance(p, line.origin));
  visit(nodes_[0], 0, 0, {line, t_min, t_max, kResidual * scale}, findings);
}

double PatchSearch::first_vertex(const Line& line, double t_min, double t_max,
                                 double distance) const {
  double first = kInfinity;
  if (!defined_) return first;
  for (const dvec3& p : patch_.P) {
    const dvec3 x = p - line.origin;
    const double t = glm::dot(x, line.direction);
    const bool is_near = glm::length(x - line.direction * t) <= distance;
    if (is_near && t >= t_min && t <= t_max) first = std::min(first, t);
  }
  return first;
}

// The least t at which the enclosed surface may meet the line. Nothing if it does not, or if it
// only may come within the margin of the line, which goes into findings.doubt_t.
std::optional<double> PatchSearch::meet(const Enclosure& enclosure, const Query& query,
                                        PatchFindings& findings) {
  const Line& line = query.line;
  double off = 0.0;
  // axis: of unit length, across the line.
  const auto is_off = [&](const dvec3& axis) {
    const Interval x = extent_along(enclosure, line.origin, axis);
    off = std::max({off, x.lo - query.residual, -x.hi - query.residual});
    return off > findings.margin;
  };
  const auto& [right, up] = line.across;
  if (is_off(right) || is_off(up)) return std::nullopt;
  // What is long and thin is off the line along an axis across one of its own sides.
  if (enclosure.count == 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const dvec3 side = enclosure.points[(k + 1) % 3] - enclosure.points[k];
      // Not their vector product with the direction: it is mere roundings if they are parallel.
      const dvec2 seen(glm::dot(side, right), glm::dot(side, up));
      const double length = glm::length(seen);
      if (length > 0.0 && is_off((up * seen.x - right * seen.y) / length)) return std::nullopt;
    }
  }
  const Interval t = extent_along(enclosure, line.origin, line.direction);
  if (t.lo > query.t_max || t.hi < query.t_min) return std::nullopt;
  if (off == 0.0) return t.lo;
  findings.doubt_t = std::min(findings.doubt_t, t.lo);
  return std::nullopt;
}

// Whether an enclosure is much larger than the sub-triangle. Where the normal shell's direction
// vanishes or turns over, the sphere surface jumps by up to the longest edge: no division makes the
// surface over such a sub-triangle small.
bool PatchSearch::is_torn(const Enclosure& enclosure, int depth) const {
  constexpr double most = 16.0;
  double width = 0.0;
  for (const dvec3& D : enclosure.D) width = std::max(width, glm::length(D));
  width *= half_width(enclosure.sigma);
  return enclosure.radius + width > most * std::ldexp(patch_.longest, -depth);
}

// Whether the projection along a line of direction d is one to one, as it is if d.(a x b) keeps its
// sign for every a of the S_u and b of the S_v: two of its values differ by such an a and b times
// the differences of the weights.
bool PatchSearch::is_one_to_one(const Tangents& tangents, const dvec3& d) {
  const auto& [S_u, S_v, off_u, off_v] = tangents;
  const double turn = std::abs(glm::dot(d, glm::cross(S_u, S_v)));
  const dvec3 both(off_u.y * off_v.z + off_u.z * off_v.y, off_u.z * off_v.x + off_u.x * off_v.z,
                   off_u.x * off_v.y + off_u.y * off_v.x);
  const double spread = glm::dot(off_u, glm::abs(glm::cross(d, S_v))) +
                        glm::dot(off_v, glm::abs(glm::cross(d, S_u))) + glm::dot(glm::abs(d), both);
  return turn > spread;
}

void PatchSearch::visit(const Node& node, std::size_t index, int depth, const Query& query,
                        PatchFindings& findings) const {
  const Line& line = query.line;
  const std::optional<double> t = meet(node.enclosure, query, findings);
  if (!t) return;
  if (node.tangent_enclosure.count > 0 && !meet(node.tangent_enclosure, query, findings)) return;

  if (node.tangents && is_one_to_one(*node.tangents, line.direction)) {
    PatchFindings::Root root{};
    root.weights = in_double::centre_of(node.sub_triangle);
    const double size = std::abs(node.sub_triangle.size);
    // A root that rounding puts just beside the sub-triangle is taken, too: dividing would not find
    // another.
    constexpr double beside = 1e-6;
    if (newton(query, 4.0 * size, root) &&
        least(in_double::weights_in(node.sub_triangle, root.weights)) > -beside) {
      record(root, line, findings);
      return;
    }
  }
  if (depth == kDeepest || (depth >= kTornDepth && is_torn(node.enclosure, depth))) {
    search_unresolved(node, *t, query, findings);
    return;
  }
  const std::size_t child = index * 4 + 1;
  if (child < nodes_.size()) {
    for (std::size_t k = 0; k < 4; ++k) {
      visit(nodes_[child + k], child + k, depth + 1, query, findings);
    }
  } else {
    // The tangents of a sub-triangle hold its children's. By them alone most children are off the
    // line, at a tenth of the cost of the children's own enclosures.
    const bool by_parent = choice_.surface == SURFACE_SPHERE && node.tangents.has_value();
    for (const in_double::SubTriangle& below : quarter(node.sub_triangle)) {
      if (by_parent && !meet(enclose_by_tangents(below, *node.tangents), query, findings)) {
        continue;
      }
      visit(node_of(below), nodes_.size(), depth + 1, query, findings);
    }
  }
}

// Newton's iteration from root.weights on the two coordinates across the line, each step halved
// until it brings the point nearer. True if it ends at a root, which may lie beyond the triangle's
// border.
bool PatchSearch::newton(const Query& query, double longest_step, PatchFindings::Root& root) const {
  const Line& line = query.line;
  const auto offset = [&](const Point& p) {
    const dvec3 x = p.S - line.origin;
    return dvec2(glm::dot(x, line.across[0]), glm::dot(x, line.across[1]));
  };
  constexpr int most_steps = 25;
  constexpr int most_halvings = 6;
  dvec3& w = root.weights;
  Point p = evaluate(w);
  dvec2 F = offset(p);
  bool polished = false;
  for (int i = 0; i < most_steps && !polished; ++i) {
    // One more step from a point that is near enough gives the last digits for little.
    polished = glm::length(F) <= query.residual;
    const dvec2 a(glm::dot(p.S_u, line.across[0]), glm::dot(p.S_u, line.across[1]));
    const dvec2 b(glm::dot(p.S_v, line.across[0]), glm::dot(p.S_v, line.across[1]));
    const double determinant = a.x * b.y - a.y * b.x;
    dvec2 step = dvec2(b.x * F.y - b.y * F.x, a.y * F.x - a.x * F.y) / determinant;
    const double length = glm::length(step);
    if (!(length < kInfinity)) break;
    if (length > longest_step) step *= longest_step / length;
    bool better = false;
    for (int k = 0; k < (polished ? 1 : most_halvings) && !better; ++k, step *= 0.5) {
      const dvec3 moved(w.x - step.x - step.y, w.y + step.x, w.z + step.y);
      const Point q = evaluate(moved);
      const dvec2 G = offset(q);
      if (!(glm::length(G) < glm::length(F))) continue;
      better = true;
      w = moved;
      p = q;
      F = G;
    }
    if (!better) break;
  }
  if (!(glm::length(F) <= query.residual)) return false;
  root.t = glm::dot(p.S - line.origin, line.direction);
  root.normal = glm::normalize(glm::cross(p.S_u, p.S_v));
  return std::isfinite(root.t) && std::isfinite(glm::dot(root.normal, root.normal));
}

// For a sub-triangle that may fold and is not divided further: Newton's iteration from its centre
// and from each of its corners, which may come to different roots. In doubt, from `t` on, in any
// case.
void PatchSearch::search_unresolved(const Node& node, double t, const Query& query,
                                    PatchFindings& findings) const {
  findings.doubt_t = std::min(findings.doubt_t, t);
  const CornerWeights weights = corner_weights(node.sub_triangle);
  const dvec3 center = in_double::centre_of(node.sub_triangle);
  for (const dvec3& start : {center, weights[0], weights[1], weights[2]}) {
    PatchFindings::Root root{};
    root.weights = start;
    if (newton(query, 4.0 / (1 << kDeepest), root)) record(root, query.line, findings);
  }
}

}  // namespace trisect
