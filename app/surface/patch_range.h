// Where the surface over a sub-triangle of a patch can lie: proven enclosures in double precision,
// from which the bounds of patches (patch_bounds.h) and the reference search (patch_search.h) are
// made.
// The functions have no state and may be called from several threads.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "app/base/interval.h"
#include "app/surface/shared.h"
#include "app/surface/surface_choice.h"
#include "app/surface/surface_double.h"

namespace trisect {

// The baked numbers of a triangle in double precision.
struct Patch {
  std::array<glm::dvec3, 3> P;     // vertices
  std::array<glm::dvec3, 3> N;     // unit normals there
  std::array<glm::dvec3, 3> D;     // the shell's directions there
  std::array<glm::dvec3, 3> data;  // curvatures toward the neighbours, and the angle between those
  glm::dvec3 n;                    // unit face normal
  double longest;                  // length of the longest edge
  in_double::Triangle triangle;    // the same for shaders/surface.glsl, with n for face normal
};

Patch patch_of(uint shell, const Triangle& tri);

// Whether a baked triangle has a surface in the shell that it was baked for: the height shell has
// none where a vertex normal lies in the face's plane, LEAST_COSINE says how closely.
inline bool has_surface(const Triangle& tri) {
  return tri.Domain.w >= 0.0F;
}

inline constexpr in_double::SubTriangle kWholeTriangle{glm::dvec3(0.0), 1.0};

// The children of a sub-triangle (in_double::child), the middle one last.
std::array<in_double::SubTriangle, 4> quarter(const in_double::SubTriangle& sub_triangle);

// The weights of a sub-triangle's corners in the patch. Exact for what quarter() and
// in_double::enlarged() make of the whole triangle.
using CornerWeights = std::array<glm::dvec3, 3>;

CornerWeights corner_weights(const in_double::SubTriangle& sub_triangle);

// The largest sum of the sizes of a corner's weights: 1 within the patch, more beyond.
double largest_weights(const CornerWeights& weights);

inline glm::dvec3 weigh(const glm::dvec3& w, const std::array<glm::dvec3, 3>& p) {
  return p[0] * w.x + p[1] * w.y + p[2] * w.z;
}

inline double longest_of(const std::array<glm::dvec3, 3>& vectors) {
  return std::max({glm::length(vectors[0]), glm::length(vectors[1]), glm::length(vectors[2])});
}

// The largest a w0 w1 + b w1 w2 + c w2 w0 over a triangle, whose corners have the weights 1. a, b
// and c are not negative.
double largest_of_products(double a, double b, double c);

// At the corners of a sub-triangle: the points of the base triangle and the shell's directions.
// Both are linear in between.
struct PatchCorners {
  std::array<glm::dvec3, 3> T;
  std::array<glm::dvec3, 3> D;
};

PatchCorners corners_of(const Patch& patch, const CornerWeights& weights);

// A set that contains S over a sub-triangle: the sum of the convex hull of the first `count`
// points, of the hull of D times the numbers in `sigma`, and of a ball of this radius, which is
// infinite where nothing is known.
struct Enclosure {
  std::array<glm::dvec3, 10> points;
  std::size_t count;
  std::array<glm::dvec3, 3> D;
  Interval sigma;
  double radius;
};

// Contains the surface for any finite normals and alpha, roundings included, also those of a point
// that is evaluated in double precision.
//
// flat:   the corners.
// phong, normal shell: sigma is a quadratic in w, S a cubic: its ten control points over the
//         sub-triangle.
// phong, height shell: sigma = alpha D.K / |D|^2 with K quadratic in w. With L the linear function
//         that agrees with sigma at the corners, T + L D is quadratic, six control points, and
//         sigma - L = (alpha D.K - L |D|^2) / |D|^2 lies between the quotients of the extreme
//         Bernstein coefficients: a band whose width falls with the square of the sub-triangle's
//         size. Where D turns too fast for that, |sigma D| <= |alpha K|.
// sphere: the range of sigma, or, where directions nearly vanish, how far a height is from its
//         vertex at most: within the patch 10/9 of the longest edge.
Enclosure enclose(const SurfaceChoice& choice, const Patch& patch,
                  const in_double::SubTriangle& sub_triangle);

// Range of (x - origin).axis over an enclosure, axis of unit length.
Interval extent_along(const Enclosure& enclosure, const glm::dvec3& origin, const glm::dvec3& axis);

}  // namespace trisect
