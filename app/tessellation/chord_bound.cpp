#include "app/tessellation/chord_bound.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/base/rounding.h"
#include "app/surface/control_net.h"
#include "app/surface/sphere_range.h"

namespace trisect {
namespace {

using glm::dvec3;

double cubic_chord_bound(const Patch& patch, const CornerWeights& piece, double alpha) {
  const DisplacementQuadratic q = phong_quadratic(patch, alpha);
  const std::array<dvec3, 3> D = corners_of(patch, piece).D;
  std::array<double, 3> at{};  // q at the corners
  std::array<double, 3> on{};  // its Bernstein coefficients at the edges 01, 12, 20
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = q.blossom(piece[i], piece[i]);
    on[i] = q.blossom(piece[i], piece[(i + 1) % 3]);
  }
  // T is linear and cancels: what remains is q D against the linear function of its corners.
  std::array<double, 3> edge{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const dvec3 iij = D[i] * (2.0 * (on[i] - at[i])) + D[j] * (at[i] - at[j]);
    const dvec3 ijj = D[j] * (2.0 * (on[i] - at[j])) + D[i] * (at[j] - at[i]);
    edge[i] = std::max(glm::length(iij), glm::length(ijj));  // three times |e|
  }
  const double middle =  // and again
      glm::length(D[2] * (on[0] - at[2]) + D[0] * (on[1] - at[0]) + D[1] * (on[2] - at[1]));
  // w_i w_j (w_i + w_j) = w_i w_j - w_0 w_1 w_2, and w_0 w_1 w_2 <= 1/27.
  const double inside = std::max(0.0, 2.0 * middle - (edge[0] + edge[1] + edge[2]));
  // Every figure is made by fewer than a hundred roundings of numbers no larger than this: a
  // coefficient of the quadratic is a difference of products as long as an edge.
  const double size = (1.0 + std::abs(alpha)) * patch.longest * 4.0 * longest_of(patch.D);
  return largest_of_products(edge[0], edge[1], edge[2]) * (1.0 + gamma_double(100)) +
         inside / 27.0 + size * gamma_double(100);
}

}  // namespace

double chord_bound(const SurfaceChoice& choice, const Patch& patch, const CornerWeights& piece) {
  if (choice.surface == SURFACE_FLAT) return 0.0;
  return choice.surface == SURFACE_SPHERE ? sphere_chord_bound(patch, piece)
                                          : cubic_chord_bound(patch, piece, choice.alpha);
}

}  // namespace trisect
