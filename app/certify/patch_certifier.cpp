#include "app/certify/patch_certifier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/base/rounding.h"
#include "app/surface/sphere_range.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec2;
using glm::dvec3;
using in_double::SubTriangle;

// At this depth, where edges have a 4096th of the patch's, a piece is not divided further.
constexpr int kDeepest = 12;
// Nor is one after so many of a patch: where the shell's direction vanishes, enclosures do not
// shrink as pieces do.
constexpr int kMostPieces = 4096;
// Krawczyk's operator must contract by this at least: closer to 1 the radius around a root becomes
// large for nothing.
constexpr double kMostContraction = 0.9;
// The least weight within a piece of the points of its core.
constexpr double kCoreWeight = kPieceMargin / (1.0 + 3.0 * kPieceMargin);
constexpr int kNewtonSteps = 12;

// Axes in the plane across along which something about `middle` may be off the tube: toward it, and
// the tube's own.
std::array<dvec2, 3> separating_axes(const dvec2& middle) {
  const double size = glm::length(middle);
  const dvec2 toward = size > 0.0 ? middle / size : dvec2(1.0, 0.0);
  return {dvec2(std::copysign(1.0, middle.x), 0.0), dvec2(0.0, std::copysign(1.0, middle.y)),
          toward};
}

// How far a tube reaches along an axis, rounded up.
double reach_of(const dvec2& axis, double radius) {
  return ((Interval(std::abs(axis.x)) + Interval(std::abs(axis.y))) * Interval(radius)).hi;
}

// Rounded up, of numbers that are not negative.
double sum_above(double a, double b) {
  return (Interval(a) + Interval(b)).hi;
}
double product_above(double a, double b) {
  return (Interval(a) * Interval(b)).hi;
}

// Weights that are multiples of 2^-50 and add up to 1 exactly. None is larger than some.
dvec3 exact_weights(const dvec3& w) {
  constexpr double units = 1125899906842624.0;  // 2^50
  const double v = std::nearbyint(w.y * units) / units;
  const double z = std::nearbyint(w.z * units) / units;
  return {1.0 - v - z, v, z};
}

// The derivatives of F by the weights 1 and 2 within a piece, and what Krawczyk's operator is made
// of.
struct Contraction {
  glm::dmat2 inverse;                             // Y, near that of the Jacobian's middle
  std::array<std::array<double, 2>, 2> distance;  // |1 - Y J| at most, rows and columns
  double factor;                                  // the largest sum of a row
};

std::optional<Contraction> contraction_of(const TangentRanges& tangents) {
  const double a = middle(tangents.u[0]);
  const double b = middle(tangents.v[0]);
  const double c = middle(tangents.u[1]);
  const double d = middle(tangents.v[1]);
  const double determinant = a * d - b * c;
  Contraction contraction{};
  // Of columns, as GLSL has it.
  contraction.inverse =
      glm::dmat2(d / determinant, -c / determinant, -b / determinant, a / determinant);
  double factor = 0.0;
  for (int i = 0; i < 2; ++i) {
    const Interval Y0(contraction.inverse[0][i]);
    const Interval Y1(contraction.inverse[1][i]);
    const Interval of_u = (i == 0 ? 1.0 : 0.0) - (Y0 * tangents.u[0] + Y1 * tangents.u[1]);
    const Interval of_v = (i == 1 ? 1.0 : 0.0) - (Y0 * tangents.v[0] + Y1 * tangents.v[1]);
    auto& row = contraction.distance[static_cast<std::size_t>(i)];
    row = {magnitude(of_u), magnitude(of_v)};
    const double sum = sum_above(row[0], row[1]);
    if (!(sum <= kMostContraction)) return std::nullopt;
    factor = std::max(factor, sum);
  }
  contraction.factor = factor;
  return contraction;
}

// Y times an interval vector.
std::array<Interval, 2> times(const glm::dmat2& inverse, const std::array<Interval, 2>& F) {
  return {Interval(inverse[0][0]) * F[0] + Interval(inverse[1][0]) * F[1],
          Interval(inverse[0][1]) * F[0] + Interval(inverse[1][1]) * F[1]};
}

// Whether a set of weights 1 and 2 within a piece, an interval each, is off the piece's core.
bool is_off_core(const Interval& u, const Interval& v) {
  const Interval first = 1.0 - u - v;
  constexpr double border = kCoreWeight - kWithinSlack;
  return u.hi < border || v.hi < border || first.hi < border;
}

Interval about(double middle, double radius) {
  return Interval(middle) + Interval(-radius, radius);
}

}  // namespace

// Where the surface over a piece lies across a tube, by the mean value theorem: its place at a
// point and what the tangents add from there.
class MeanValueForm {
 public:
  MeanValueForm(const SubTriangle& piece, const TangentRanges& tangents, const dvec3& center,
                const std::array<Interval, 2>& at_center)
      : piece_(piece), tangents_(tangents), center_(center), at_center_(at_center) {}

  // Whether a part of the piece is off the tube along an axis, which `certificate` then says.
  bool prove_off(const SubTriangle& part, double radius, Certificate& certificate) const {
    // The bounds are convex in the weights: their largest values are at corners.
    std::array<std::array<Interval, 2>, 3> places;
    dvec2 sum(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const dvec3 l = in_double::weights_in(piece_, corner_weights(part)[k]);
      for (std::size_t i = 0; i < 2; ++i) {
        places[k][i] = at_center_[i] + tangents_.u[i] * about(l.y - center_.y) +
                       tangents_.v[i] * about(l.z - center_.z);
        sum[static_cast<int>(i)] += middle(places[k][i]);
      }
    }
    for (const dvec2& axis : separating_axes(sum)) {
      const bool is_off = std::all_of(places.begin(), places.end(), [&](const auto& place) {
        return (Interval(axis.x) * place[0] + Interval(axis.y) * place[1]).lo >
               reach_of(axis, radius);
      });
      if (!is_off) continue;
      certificate.axis = axis;
      return true;
    }
    return false;
  }

 private:
  // A difference of weights within, with its roundings.
  static Interval about(double difference) {
    return {difference - kWithinSlack, difference + kWithinSlack};
  }

  SubTriangle piece_;
  TangentRanges tangents_;
  dvec3 center_;
  std::array<Interval, 2> at_center_;
};

void TubeFindings::clear() {
  roots.clear();
  open.clear();
  t_end = kInfinity;
  pieces = 0;
  used_tangents = false;
}

void TubeFindings::add(const Certificate& certificate) const {
  if (certificates != nullptr) certificates->push_back(certificate);
}

void TubeFindings::leave_open(Doubt doubt, double t) {
  open.push_back({doubt, t});
  t_end = std::min(t_end, t);
}

PatchCertifier::PatchCertifier(const SurfaceChoice& choice, const Triangle& tri, uint32_t index,
                               int levels)
    : choice_(choice),
      patch_(patch_of(choice.shell, tri)),
      shape_(shape_of(choice)),
      index_(index),
      // A piece's weights beyond the patch add up to less than 2.
      roundings_(gamma_double(200) * longest_of(patch_.P)),
      defined_(has_surface(tri)) {
  if (!defined_) return;
  // Hulls of second order: of the sphere surface alone, whose others are of first.
  const bool has_flat = choice.surface == SURFACE_SPHERE && choice.shell == SHELL_NORMAL;
  const auto keep = [&](const SubTriangle& sub_triangle, int level) {
    nodes_.push_back(node_of(sub_triangle));
    if (!has_flat) return;
    FlatPieces flat = flat_pieces_of(sub_triangle, std::min(2, levels - level));
    const bool is_finite = std::all_of(flat.points.begin(), flat.points.end(), [&](const dvec3& p) {
      return std::isfinite(glm::dot(p, p) + flat.radius);
    });
    if (is_finite) nodes_.back().flat = std::move(flat);
  };
  keep(kWholeTriangle, 0);
  std::size_t first = 0;
  for (int level = 0; level < levels; ++level) {
    const std::size_t last = nodes_.size();
    for (; first < last; ++first) {
      for (const SubTriangle& below : quarter(nodes_[first].sub_triangle)) keep(below, level + 1);
    }
  }
}

double PatchCertifier::bytes_of(const SurfaceChoice& choice, int levels) {
  const double nodes = (std::pow(4.0, levels + 1) - 1.0) / 3.0;
  // Of the sphere surface up to fifteen points, and some room that the vector keeps.
  const double points = choice.surface == SURFACE_SPHERE ? 16.0 * sizeof(dvec3) : 0.0;
  return sizeof(PatchCertifier) + nodes * (sizeof(Node) + points);
}

PatchCertifier::Node PatchCertifier::node_of(const SubTriangle& sub_triangle) const {
  return {sub_triangle, enclose(choice_, patch_, sub_triangle), {}};
}

PatchCertifier::FlatPieces PatchCertifier::flat_pieces_of(const SubTriangle& sub_triangle,
                                                          int divisions) const {
  FlatPieces flat;
  if (divisions == 0) {
    const CornerWeights weights = corner_weights(sub_triangle);
    flat.radius = sphere_chord_bound(patch_, weights);
    for (const dvec3& w : weights) {
      flat.points.push_back(in_double::surface_point(shape_, patch_.triangle, w));
    }
    return flat;
  }
  for (const SubTriangle& below : quarter(sub_triangle)) {
    const FlatPieces part = flat_pieces_of(below, divisions - 1);
    // So that a NaN stays one.
    if (!(part.radius <= flat.radius)) flat.radius = part.radius;
    for (const dvec3& point : part.points) {
      if (std::find(flat.points.begin(), flat.points.end(), point) == flat.points.end()) {
        flat.points.push_back(point);
      }
    }
  }
  return flat;
}

// extent_along() with room for the roundings of points of the patch, which do not cancel where the
// points come near the scene's origin.
Interval PatchCertifier::extent(const Enclosure& enclosure, const dvec3& origin,
                                const dvec3& axis) const {
  return extent_along(enclosure, origin, axis) + Interval(-roundings_, roundings_);
}

// The extents of both enclosures along an axis of about unit length, as far as they agree.
Interval PatchCertifier::extent_of(const Node& node, const dvec3& origin, const dvec3& axis) const {
  const Interval a = extent(node.enclosure, origin, axis);
  if (node.flat.points.empty()) return a;
  Enclosure flat{};
  Interval b(kInfinity, -kInfinity);
  // Ten of the points at a time.
  const std::vector<dvec3>& points = node.flat.points;
  for (std::size_t first = 0; first < points.size(); first += flat.points.size()) {
    flat.count = std::min(flat.points.size(), points.size() - first);
    flat.radius = node.flat.radius;
    std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(first), flat.count,
                flat.points.begin());
    b = hull(b, extent(flat, origin, axis));
  }
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

void PatchCertifier::search(const RayTube& tube, TubeFindings& findings) const {
  if (!defined_) return;
  findings.pieces = 0;
  visit(nodes_[0], 0, 0, tube, findings);
}

void PatchCertifier::visit(const Node& node, std::size_t index, int depth, const RayTube& tube,
                           TubeFindings& findings) const {
  ++findings.pieces;
  const Interval t = extent_of(node, tube.origin, tube.direction);
  if (is_off(node, t, tube, findings)) return;
  std::optional<MeanValueForm> form;
  const std::optional<Doubt> doubt = prove_by_tangents(node.sub_triangle, tube, findings, form);
  if (!doubt) return;
  if (depth == kDeepest || findings.pieces >= kMostPieces) {
    leave_open(node.sub_triangle, *doubt, t.lo, findings);
    return;
  }
  const std::array<SubTriangle, 4> children = quarter(node.sub_triangle);
  const std::size_t child = index * 4 + 1;
  for (std::size_t k = 0; k < 4; ++k) {
    Certificate certificate{CertificateKind::hull, index_, children[k]};
    if (form && form->prove_off(children[k], tube.radius, certificate)) {
      findings.add(certificate);
    } else if (child < nodes_.size()) {
      visit(nodes_[child + k], child + k, depth + 1, tube, findings);
    } else {
      visit(node_of(children[k]), nodes_.size(), depth + 1, tube, findings);
    }
  }
}

// What lies behind an answer may stay open: that it does is a certificate.
void PatchCertifier::leave_open(const SubTriangle& core, Doubt doubt, double t,
                                TubeFindings& findings) const {
  findings.leave_open(doubt, t);
  Certificate certificate{CertificateKind::behind, index_, core};
  certificate.t = {t, kInfinity};
  findings.add(certificate);
}

// Comparisons are such that a NaN proves nothing.
bool PatchCertifier::is_off(const Node& node, const Interval& t, const RayTube& tube,
                            TubeFindings& findings) const {
  Certificate certificate{CertificateKind::hull, index_, node.sub_triangle};
  dvec2 middle(0.0);
  for (std::size_t k = 0; k < node.enclosure.count; ++k) {
    const dvec3 x = node.enclosure.points[k] - tube.origin;
    middle += dvec2(glm::dot(x, tube.across[0]), glm::dot(x, tube.across[1]));
  }
  bool proven = false;
  for (const dvec2& axis : separating_axes(middle)) {
    // The axis' own roundings are among those that extents have room for.
    const dvec3 across = tube.across[0] * axis.x + tube.across[1] * axis.y;
    proven = extent_of(node, tube.origin, across).lo > reach_of(axis, tube.radius);
    certificate.axis = axis;
    if (proven) break;
  }
  if (!proven && t.hi < tube.t_min - tube.radius) {
    proven = true;
    certificate.kind = CertificateKind::before;
  }
  if (!proven && t.lo > findings.t_end) {
    proven = true;
    certificate.kind = CertificateKind::behind;
    certificate.t = {findings.t_end, kInfinity};
  }
  if (proven) findings.add(certificate);
  return proven;
}

// Where Newton's method ends, held within the piece: weights of the patch. It need not be a root:
// what is proven about the point does not depend on how it was found.
dvec3 PatchCertifier::newton(const SubTriangle& piece, const RayTube& tube) const {
  dvec3 l(1.0 / 3.0);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const dvec3 w = in_double::weights_of(piece, l);
    const in_double::Displacement sigma =
        in_double::displacement_and_derivatives(shape_, patch_.triangle, w);
    const dvec3 D = weigh(w, patch_.D);
    const dvec3 S = weigh(w, patch_.P) + D * sigma.s - tube.origin;
    const auto along = [&](std::size_t vertex, double slope) {
      const dvec3 tangent =
          patch_.P[vertex] - patch_.P[0] + D * slope + (patch_.D[vertex] - patch_.D[0]) * sigma.s;
      return dvec2(glm::dot(tangent, tube.across[0]), glm::dot(tangent, tube.across[1])) *
             piece.size;
    };
    const dvec2 step = glm::inverse(glm::dmat2(along(1, sigma.u), along(2, sigma.v))) *
                       dvec2(glm::dot(S, tube.across[0]), glm::dot(S, tube.across[1]));
    dvec3 next(l.x + step.x + step.y, l.y - step.x, l.z - step.y);
    // Inside, whatever its roundings: the tangents' ranges hold there.
    next = glm::max(next, dvec3(1e-9));
    next /= next.x + next.y + next.z;
    const double moved = glm::distance(next, l);
    if (!std::isfinite(moved)) break;
    l = next;
    if (moved < 1e-13) break;
  }
  return exact_weights(in_double::weights_of(piece, l));
}

// With l the weights 1 and 2 within the piece, c a point of it, and Y any matrix: where F(l) = e,
//   l - c = Y (e - F(c)) + (1 - Y J) (l - c),
// J the mean of the tangents between c and l that the mean value theorem has, row by row. So l is
// in the box around c - Y F(c) that the extents of e and of l - c give, Krawczyk's operator; and as
// l -> l - Y (F(l) - e) contracts by q = |1 - Y J| in the piece, the ball around c of the radius
// |Y (e - F(c))| / (1 - q) is mapped into itself: if the piece holds it, it holds one root
// (Banach), and that is the only one of the piece.
//
// Before that the tangents are tried as a hull, of second order where the enclosure is of first.
//
// Nothing if the core of the piece is dealt with: its root was added to the findings, or that it
// may have one beside the patch's border; or there is none. Else why not.
std::optional<Doubt> PatchCertifier::prove_by_tangents(const SubTriangle& core, const RayTube& tube,
                                                       TubeFindings& findings,
                                                       std::optional<MeanValueForm>& form) const {
  const SubTriangle piece = in_double::enlarged(core, kPieceMargin);
  const std::optional<TangentRanges> tangents =
      tangent_ranges(choice_, patch_, piece, {tube.across[0], tube.across[1], tube.direction});
  if (!tangents) return Doubt::nonsmooth;
  const dvec3 middle = exact_weights(in_double::centre_of(core));
  const Enclosure at_middle = enclose(choice_, patch_, {middle, 0.0});
  form.emplace(piece, *tangents, in_double::weights_in(piece, middle),
               std::array{extent(at_middle, tube.origin, tube.across[0]),
                          extent(at_middle, tube.origin, tube.across[1])});
  Certificate hull{CertificateKind::hull, index_, core};
  if (form->prove_off(core, tube.radius, hull)) {
    findings.add(hull);
    return std::nullopt;
  }
  const std::optional<Contraction> contraction = contraction_of(*tangents);
  if (!contraction) return Doubt::fold;
  const auto& [inverse, distance, factor] = *contraction;

  const double piece_size = std::abs(piece.size);
  const dvec3 center = newton(piece, tube);
  const dvec3 within = in_double::weights_in(piece, center);
  const Enclosure at = enclose(choice_, patch_, {center, 0.0});
  const Interval spread(-tube.radius, tube.radius);
  const std::array<Interval, 2> miss =
      times(inverse, {extent(at, tube.origin, tube.across[0]) + spread,
                      extent(at, tube.origin, tube.across[1]) + spread});

  const std::array<double, 2> place{within.y, within.z};
  std::array<Interval, 2> box;
  for (std::size_t i = 0; i < 2; ++i) {
    double reach = kWithinSlack;
    for (std::size_t j = 0; j < 2; ++j) {
      const double farthest = std::max(place[j], 1.0 - place[j]) + kWithinSlack;
      reach = sum_above(reach, product_above(distance[i][j], farthest));
    }
    box[i] = place[i] - miss[i] + Interval(-reach, reach);
  }
  Certificate certificate{CertificateKind::no_root, index_, core};
  const auto proven = [&] {
    findings.used_tangents = true;
    findings.add(certificate);
  };
  if (is_off_core(box[0], box[1])) {
    proven();
    return std::nullopt;
  }

  if (!std::isfinite(magnitude(miss[0]) + magnitude(miss[1]))) return Doubt::nonsmooth;
  const double farthest = std::max(magnitude(miss[0]), magnitude(miss[1]));
  const double radius = divide_by_positive(farthest, 1.0 - Interval(factor)).hi;
  const double held = radius + kWithinSlack;
  const bool is_held =
      within.y - held >= 0.0 && within.z - held >= 0.0 && within.x - 2.0 * held >= 0.0;
  if (!is_held) {
    // Smaller pieces do not help where the tube is wide for this one.
    const double wide = tube.radius * std::max(std::abs(inverse[0][0]) + std::abs(inverse[1][0]),
                                               std::abs(inverse[0][1]) + std::abs(inverse[1][1]));
    if (!(wide > 0.5 * kCoreWeight)) return Doubt::fold;
    const bool is_inside = std::min({center.x, center.y, center.z}) > 2.0 * wide * piece_size;
    const double t = (extent(at, tube.origin, tube.direction) - magnitude(tangents->u[2]) -
                      magnitude(tangents->v[2]))
                         .lo;
    leave_open(core, is_inside ? Doubt::fold : Doubt::border, t, findings);
    return std::nullopt;
  }

  const double along = sum_above(product_above(magnitude(tangents->u[2]), radius),
                                 product_above(magnitude(tangents->v[2]), radius));
  certificate.kind = CertificateKind::one_root;
  certificate.piece = piece;
  certificate.core = core;
  certificate.weights = center;
  certificate.weight_radius = product_above(piece_size, radius);
  certificate.t = extent(at, tube.origin, tube.direction) + Interval(-along, along);
  proven();
  // The root of another core, or of none.
  if (is_off_core(about(within.y, held), about(within.z, held))) return std::nullopt;
  if (certificate.t.hi < tube.t_min - tube.radius) return std::nullopt;
  const double off = certificate.weight_radius;
  const bool is_inside =
      center.y - off > 0.0 && center.z - off > 0.0 && (center.x - 2.0 * off) > 0.0;
  if (!is_inside) {
    findings.leave_open(Doubt::border, certificate.t.lo);
    return std::nullopt;
  }
  findings.roots.push_back({index_, piece, center, off, certificate.t});
  if (certificate.t.lo > tube.t_min + tube.radius) {
    findings.t_end = std::min(findings.t_end, certificate.t.hi);
  }
  return std::nullopt;
}

}  // namespace trisect
