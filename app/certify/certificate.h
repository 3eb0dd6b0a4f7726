// What is proven of the surface over a sub-triangle of a patch, for all rays of a tube.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "app/base/interval.h"
#include "app/surface/surface_double.h"

namespace trisect {

// A ray and all that are parallel to it and begin beside its beginning, no farther away than
// `radius` along either axis across. The directions are of unit length and at right angles.
struct RayTube {
  glm::dvec3 origin;
  glm::dvec3 direction;
  std::array<glm::dvec3, 2> across;
  double t_min;   // where the rays begin
  double radius;  // not negative
};

// F(w) = ((S(w) - origin).across[0], (S(w) - origin).across[1]) is where the surface lies across
// the tube; t(w) = (S(w) - origin).direction, how far along.
enum class CertificateKind {
  // Along an axis a of the plane across the surface lies beyond the tube, a.F > |a|_1 radius, so no
  // ray of it meets the sub-triangle.
  hull,
  // The sub-triangle lies before the rays' beginning: t < t_min - radius.
  before,
  // It lies behind what decides already: t > `t.lo` of this certificate.
  behind,
  // No ray meets the sub-triangle: Krawczyk's operator maps the enlarged one off it.
  no_root,
  // Every ray meets the enlarged sub-triangle once, within weight_radius of `weights` (the patch's
  // weights 1 and 2) and at one of this certificate's t.
  one_root
};

struct Certificate {
  CertificateKind kind;
  uint32_t triangle;
  in_double::SubTriangle piece;
  // The sub-triangle that is dealt with by that: the piece or, of one_root, what it enlarges.
  in_double::SubTriangle core = piece;
  // hull: a, which need not be of unit length.
  glm::dvec2 axis{0.0};
  // one_root
  glm::dvec3 weights{0.0};
  double weight_radius = 0.0;
  // behind, one_root
  Interval t;
};

// How far a piece reaches beyond the sub-triangle that it is searched for, on each side, as a part
// of its size: a root on the border between two is well within the pieces of both.
inline constexpr double kPieceMargin = 0.125;

// Weights within a piece are computed from those of the patch, with some roundings over the size of
// the smallest piece.
inline constexpr double kWithinSlack = 1e-11;

}  // namespace trisect
