#include "app/surface/sphere_range.h"

#include <algorithm>
#include <cmath>

#include "app/base/rounding.h"
#include "app/surface/surface_double.h"

namespace trisect {
namespace {

using glm::dvec3;
using in_double::HeightRange;

// The corners of a sub-triangle, with the rounding of their weighted sums: three of it, on the way
// of each vertex or direction into a corner, and one more where another vertex is subtracted.
in_double::Corners corners_with_error(const CornerWeights& weights,
                                      const std::array<dvec3, 3>& vectors,
                                      const std::array<dvec3, 3>& at_corners) {
  return {at_corners[0], at_corners[1], at_corners[2],
          gamma_double(4) * largest_weights(weights) * longest_of(vectors)};
}

// What the ranges of sigma over a sub-triangle are made from.
struct SphereOverSubTriangle {
  in_double::Corners T;
  in_double::Corners D;
  Interval DD;
  std::array<Interval, 3> w;
};

SphereOverSubTriangle sphere_over(const Patch& patch, const CornerWeights& weights,
                                  const PatchCorners& corners) {
  SphereOverSubTriangle over{};
  over.T = corners_with_error(weights, patch.P, corners.T);
  over.D = corners_with_error(weights, patch.D, corners.D);
  over.DD = in_double::square_range(over.D, patch.n);
  for (int i = 0; i < 3; ++i) {
    const auto [lo, hi] = std::minmax({weights[0][i], weights[1][i], weights[2][i]});
    over.w[static_cast<std::size_t>(i)] = {lo, hi};
  }
  return over;
}

// Whether s_i is s all over a sub-triangle of which h is the range, next to the vertex too, where
// both s and the distance x from it fall to 0. Compares what they are to x: by the definition
// |s| <= (|c| x + 2 |x.N| / x) x / (B + slope), where x.N / x is at most the length of N along the
// face, and s is free up to 5/4 x / |D|.
bool is_free_by_slope(const Patch& patch, std::size_t i, const HeightRange& h) {
  const double along = glm::length(patch.N[i] - patch.n * glm::dot(patch.N[i], patch.n));
  // N and n are unit vectors, and n, a cross product, is off by 8 roundings over the sine between
  // two edges.
  const dvec3 E1 = patch.P[1] - patch.P[0];
  const dvec3 E2 = patch.P[2] - patch.P[0];
  const double sine = glm::length(glm::cross(E1, E2)) / (glm::length(E1) * glm::length(E2));
  const double most_along = along + gamma_double(16) + gamma_double(16) / sine;
  const Interval most =
      (Interval(in_double::range_magnitude(h.c)) * root(h.xx) + 2.0 * most_along) * root(h.DD);
  return h.regular && most.hi < (in_double::FREE * in_double::HIGHEST * (h.B + h.slope)).lo;
}

HeightRange height_range(const Patch& patch, std::size_t i, const SphereOverSubTriangle& over) {
  HeightRange h =
      in_double::height_range(patch.triangle, static_cast<int>(i), over.T, over.D, over.DD);
  if (!h.free && is_free_by_slope(patch, i, h)) {
    h.free = true;
    h.height = h.s;
  }
  return h;
}

// Whether s_i is where the line meets the sphere by the definition, all over a sub-triangle.
bool is_free_root(const HeightRange& h) {
  return h.regular && h.free;
}

// Whether the directions do not vanish. Written so that a NaN is no direction.
bool has_directions(const SphereOverSubTriangle& over) {
  return over.DD.lo > in_double::LEAST_DIRECTION_SQUARE;
}

double longest_edge(const in_double::Corners& a) {
  return std::max({glm::length(a.a - a.b), glm::length(a.b - a.c), glm::length(a.a - a.c)});
}

// Whether s_i is smooth over a sub-triangle as far as samples show that have a third of its width:
// by the definition it is analytic away from the vertex; where it leaves the definition it is a
// function of the angles between x, D and N and of c |x|, with a derivative that is Lipschitz and
// of the order of 1, so it is smooth if these change little.
bool is_smooth(const HeightRange& h) {
  if (is_free_root(h)) return true;
  constexpr double little = 0.5;
  const double edge = longest_edge(h.x);
  return longest_edge(h.D) < 0.5 * little * root(h.DD).lo && edge < little * root(h.xx).lo &&
         edge * in_double::range_magnitude(h.c) < little;
}

// Whether s_i is the root all over a sub-triangle and has bounded derivatives there.
bool is_root_with_derivatives(const Patch& patch, std::size_t i, const HeightRange& h) {
  return is_free_root(h) && h.xx.lo > 0.0 && patch.data[i].z > 0.0;
}

// The first and the second derivative of s_i along a direction in which T moves by e and D by d.
struct HeightDerivatives {
  Interval first;
  Interval second;
};

// p = x + s D solves c p.p / 2 + p.N = 0. With g = c p + N, whose product with D is the root of the
// discriminant, and primes for derivatives, twice differentiated:
//   g.p'' + 2 c' p.p' + c p'.p' + c'' p.p / 2 = 0, p' = e + s d + s' D, p'' = s'' D + 2 s' d.
// c depends on the angle of x: c' = rate t / x.x with t = x.(e x turn), c'' = -2 c' x.e / x.x.
HeightDerivatives height_derivatives(const HeightRange& h, const dvec3& e, const dvec3& d) {
  const Interval s = h.height;
  const Interval s1 = in_double::height_change(h, e, d);
  const Interval ee = in_double::dot_range(e, e);
  const Interval xe = in_double::linear_range(h.x, e);
  const Interval xd = in_double::linear_range(h.x, d);
  const Interval De = in_double::linear_range(h.D, e);
  const Interval Dd = in_double::linear_range(h.D, d);
  const Interval moved = ee + square(s) * in_double::dot_range(d, d) + square(s1) * h.DD +
                         2.0 * (s * in_double::dot_range(e, d) + s1 * De + s * s1 * Dd);
  const Interval pp1 = xe + s * (xd + De) + s1 * h.xD + square(s) * Dd + s * s1 * h.DD;
  const Interval gd = h.c * (xd + s * Dd) + in_double::dot_range(h.N, d);
  Interval turned;  // 2 c' p.p' + c'' p.p / 2
  if (h.xx.lo > 0.0) {
    const Interval pp = h.xx + 2.0 * s * h.xD + square(s) * h.DD;
    const Interval change =
        divide_by_positive(in_double::linear_range(h.x, glm::cross(e, h.turn)) * h.rate, h.xx);
    turned = change * (2.0 * pp1 - divide_by_positive(pp, h.xx) * xe);
  } else {
    // |t| <= |x| |e|, and |p| <= 9/4 |x| as s is free.
    const Interval size = root(ee);
    const double most = (5.1 * in_double::range_magnitude(h.rate) * size * (root(moved) + size)).hi;
    turned = {-most, most};
  }
  return {s1, divide_by_positive(-(2.0 * s1 * gd + turned + h.c * moved), h.slope)};
}

// The three bounds of |sigma - linear| (sphere_chord_bound).
double by_second_derivatives(const std::array<Interval, 3>& second, const CornerWeights& weights,
                             const SphereOverSubTriangle& over) {
  std::array<double, 3> bent{};  // |H| along the piece's own edges, H the middle of the ranges
  double rest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec3 d = weights[(k + 1) % 3] - weights[k];
    double H = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = static_cast<int>(i);
      const int b = (a + 1) % 3;
      H -= d[a] * d[b] * 0.5 * (second[i].lo + second[i].hi);
    }
    bent[k] = std::abs(H);
    const std::size_t next = (k + 1) % 3;
    rest += (over.w[k].hi - over.w[k].lo) * (over.w[next].hi - over.w[next].lo) *
            (second[k].hi - second[k].lo);
  }
  return 0.5 * largest_of_products(bent[0], bent[1], bent[2]) + rest / 16.0;
}

double by_derivatives(const Patch& patch, const std::array<HeightRange, 3>& heights,
                      const SphereOverSubTriangle& over) {
  std::array<double, 3> widths{};  // of the derivatives from vertex i toward the next
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    Interval along = heights[j].height - heights[i].height;
    for (std::size_t k = 0; k < 3; ++k) {
      along = along + over.w[k] * in_double::height_change(heights[k], patch.P[j] - patch.P[i],
                                                           patch.D[j] - patch.D[i]);
    }
    widths[i] = along.hi - along.lo;
  }
  // Of the three pairs of coordinates the best counts: from a vertex toward the other two.
  double best = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const std::size_t last = (i + 2) % 3;
    const double off = 0.25 * (widths[i] * (over.w[next].hi - over.w[next].lo) +
                               widths[last] * (over.w[last].hi - over.w[last].lo));
    if (off < best) best = off;
  }
  return best;
}

std::optional<std::array<Interval, 3>> second_derivative_ranges(
    const Patch& patch, const std::array<HeightRange, 3>& heights,
    const SphereOverSubTriangle& over) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!is_free_root(heights[k])) return std::nullopt;
  }
  std::array<Interval, 3> second{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const dvec3 e = patch.P[j] - patch.P[i];
    const dvec3 d = patch.D[j] - patch.D[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const HeightDerivatives s = height_derivatives(heights[k], e, d);
      second[i] = second[i] + over.w[k] * s.second;
      // The weights' own derivatives are -1 at i and 1 at j.
      if (k == i) second[i] = second[i] - 2.0 * s.first;
      if (k == j) second[i] = second[i] + 2.0 * s.first;
    }
  }
  return second;
}

// Far below what stands for infinity, far above any derivative of a scene. A NaN is not bounded.
bool is_bounded(const Interval& a) {
  return a.lo > -1e-3 * in_double::UNBOUNDED && a.hi < 1e-3 * in_double::UNBOUNDED;
}

// Whether a bound of the height's change is known. Asked before anything is multiplied by what
// stands for infinity.
bool has_bounded_change(const Patch& patch, const HeightRange& h) {
  if (!is_bounded(h.rate)) return false;
  for (std::size_t k = 1; k < 3; ++k) {
    const dvec3 dT = patch.P[k] - patch.P[0];
    if (!is_bounded(in_double::height_change(h, dT, patch.D[k] - patch.D[0]))) return false;
  }
  return true;
}

// The ranges of sigma and of what it changes by, if each height's are known: has_ranges(i, h).
template <typename HasRanges>
std::optional<SigmaRanges> sigma_ranges(const Patch& patch, const CornerWeights& weights,
                                        const PatchCorners& corners, const HasRanges& has_ranges) {
  const SphereOverSubTriangle over = sphere_over(patch, weights, corners);
  if (!has_directions(over)) return std::nullopt;
  const auto& P = patch.P;
  const auto& D = patch.D;
  in_double::SphereRange sigma{0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const HeightRange h = height_range(patch, i, over);
    if (!has_ranges(i, h)) return std::nullopt;
    in_double::add_height(sigma, static_cast<int>(i), h, over.w[i], P[1] - P[0], P[2] - P[0],
                          D[1] - D[0], D[2] - D[0]);
  }
  return SigmaRanges{sigma.s, sigma.u, sigma.v};
}

std::array<HeightRange, 3> height_ranges(const Patch& patch, const SphereOverSubTriangle& over) {
  return {height_range(patch, 0, over), height_range(patch, 1, over), height_range(patch, 2, over)};
}

}  // namespace

Interval direction_square_range(const Patch& patch, const CornerWeights& weights,
                                const PatchCorners& corners) {
  return in_double::square_range(corners_with_error(weights, patch.D, corners.D), patch.n);
}

std::optional<Interval> sphere_sigma_range(const Patch& patch, const CornerWeights& weights,
                                           const PatchCorners& corners) {
  const SphereOverSubTriangle over = sphere_over(patch, weights, corners);
  if (!has_directions(over)) return std::nullopt;
  Interval sigma(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    sigma = sigma + over.w[i] * height_range(patch, i, over).height;
  }
  return sigma;
}

bool sphere_is_smooth(const Patch& patch, const CornerWeights& weights) {
  const SphereOverSubTriangle over = sphere_over(patch, weights, corners_of(patch, weights));
  if (!has_directions(over)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!is_smooth(height_range(patch, i, over))) return false;
  }
  return true;
}

std::optional<SigmaRanges> sphere_derivative_ranges(const Patch& patch,
                                                    const CornerWeights& weights,
                                                    const PatchCorners& corners) {
  return sigma_ranges(patch, weights, corners, [&](std::size_t i, const HeightRange& h) {
    return is_root_with_derivatives(patch, i, h);
  });
}

std::optional<SigmaRanges> sphere_change_ranges(const Patch& patch, const CornerWeights& weights,
                                                const PatchCorners& corners) {
  const auto sigma = sigma_ranges(patch, weights, corners, [&](std::size_t, const HeightRange& h) {
    return has_bounded_change(patch, h);
  });
  if (!sigma || !is_bounded(sigma->s) || !is_bounded(sigma->u) || !is_bounded(sigma->v)) {
    return std::nullopt;
  }
  return sigma;
}

std::optional<std::array<Interval, 3>> sphere_second_derivative_ranges(
    const Patch& patch, const CornerWeights& weights) {
  const SphereOverSubTriangle over = sphere_over(patch, weights, corners_of(patch, weights));
  if (!has_directions(over)) return std::nullopt;
  return second_derivative_ranges(patch, height_ranges(patch, over), over);
}

double sphere_chord_bound(const Patch& patch, const CornerWeights& weights) {
  const PatchCorners corners = corners_of(patch, weights);
  // No point is displaced by more than so many times its distance from a vertex (HIGHEST).
  const double farthest = 2.0 * in_double::HIGHEST * patch.longest * (1.0 + gamma_double(100));
  const SphereOverSubTriangle over = sphere_over(patch, weights, corners);
  if (!has_directions(over)) return farthest;
  const std::array<HeightRange, 3> heights = height_ranges(patch, over);
  Interval sigma(0.0);
  for (std::size_t i = 0; i < 3; ++i) sigma = sigma + over.w[i] * heights[i].height;
  // Written so that a NaN bounds nothing.
  double off = sigma.hi - sigma.lo;
  const auto second = second_derivative_ranges(patch, heights, over);
  for (const double other : {by_derivatives(patch, heights, over),
                             second ? by_second_derivatives(*second, weights, over) : off}) {
    if (other < off) off = other;
  }
  std::array<double, 3> at{};
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] =
        in_double::displacement({SURFACE_SPHERE, SHELL_NORMAL, 0.0}, patch.triangle, weights[i]);
  }
  double turn = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    turn = std::max(turn, std::abs(at[i] - at[j]) * glm::length(corners.D[i] - corners.D[j]));
  }
  // The sum of l_i l_j over the pairs is 1/3 at most. The slack covers the roundings of points;
  // where sigma is steep those grow, but there the bound is made of sigma's range, which holds
  // them.
  const double bound = off * longest_of(corners.D) + turn / 3.0;
  const double slack = patch.longest * gamma_double(900);
  return bound < farthest ? bound * (1.0 + gamma_double(100)) + slack : farthest;
}

}  // namespace trisect
