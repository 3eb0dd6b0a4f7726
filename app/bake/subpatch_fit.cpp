#include "app/bake/subpatch_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/base/max_propagating_nan.h"
#include "app/base/rounding.h"
#include "app/surface/sphere_range.h"

namespace trisect {
namespace {

using glm::dvec3;

using in_double::SubTriangle;

// Interval arithmetic is tighter over small pieces: a subpatch is examined in 4^2 of them.
constexpr int kProofDivisions = 2;

// sigma is sampled at the weights with this denominator, 91 points. What the samples show is
// multiplied by kBetweenSamples for the points between them, which is a margin and no proof.
constexpr int kSamples = 12;
constexpr double kBetweenSamples = 1.5;

dvec3 vertex_weights(int k) {
  dvec3 e(0.0);
  e[k] = 1.0;
  return e;
}

// The quadratic with these values at the corners of a sub-triangle and at the midpoints of its
// edges.
template <typename Value>
DisplacementQuadratic through(const SubTriangle& sub_triangle, Value&& value) {
  const auto at = [&](const dvec3& l) { return value(in_double::weights_of(sub_triangle, l)); };
  DisplacementQuadratic local;
  for (int k = 0; k < 3; ++k) local.corner[k] = at(vertex_weights(k));
  for (int k = 0; k < 3; ++k) {
    const int i = k == 2 ? 0 : k;
    const int j = k == 2 ? 2 : k + 1;
    local.edge[k] = 2.0 * at((vertex_weights(i) + vertex_weights(j)) * 0.5) -
                    (local.corner[i] + local.corner[j]) * 0.5;
  }
  // Over the whole triangle: its vertices may lie outside the sub-triangle, a blossom has values
  // there, too.
  const auto inside = [&](int k) { return in_double::weights_in(sub_triangle, vertex_weights(k)); };
  DisplacementQuadratic whole;
  for (int k = 0; k < 3; ++k) whole.corner[k] = local.blossom(inside(k), inside(k));
  whole.edge = {local.blossom(inside(0), inside(1)), local.blossom(inside(1), inside(2)),
                local.blossom(inside(0), inside(2))};
  return whole;
}

struct Sample {
  dvec3 w;
  double e;             // sigma - q
  glm::dvec2 gradient;  // of e, by the weights 1 and 2
};

Sample sample(const PatchData& patch, const DisplacementQuadratic& q, const dvec3& w) {
  const in_double::Displacement sigma =
      in_double::displacement_and_derivatives(patch.shape, patch.tri, w);
  return {w,
          sigma.s - q.blossom(w, w),
          {sigma.u - 2.0 * q.blossom(w, {-1.0, 1.0, 0.0}),
           sigma.v - 2.0 * q.blossom(w, {-1.0, 0.0, 1.0})}};
}

std::vector<Sample> samples_of(const PatchData& patch, const SubTriangle& sub_triangle,
                               const DisplacementQuadratic& q) {
  std::vector<Sample> samples;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; i + j <= kSamples; ++j) {
      const dvec3 l = dvec3(kSamples - i - j, i, j) / static_cast<double>(kSamples);
      samples.push_back(sample(patch, q, in_double::weights_of(sub_triangle, l)));
    }
  }
  return samples;
}

// The largest change of the gradient between neighbours of samples_of, over their distance in
// weights within the sub-triangle. Between samples farther apart the gradient changes in such
// steps.
double steepest_change(const std::vector<Sample>& samples) {
  double steepest = 0.0;
  // The rows are stored one after the other; row i has kSamples + 1 - i samples.
  const auto at = [&](int i, int j) -> const Sample& {
    const int row = i * (kSamples + 1) - i * (i - 1) / 2;
    return samples[static_cast<std::size_t>(row) + static_cast<std::size_t>(j)];
  };
  constexpr std::array<glm::ivec2, 4> steps{glm::ivec2(1, 0), {0, 1}, {1, -1}, {1, 1}};
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; i + j <= kSamples; ++j) {
      for (const glm::ivec2& step : steps) {
        const int k = i + step.x;
        const int l = j + step.y;
        if (l < 0 || k + l > kSamples) continue;
        max_propagating_nan(steepest, glm::distance(at(i, j).gradient, at(k, l).gradient) *
                                          kSamples / glm::length(glm::dvec2(step)));
      }
    }
  }
  return steepest;
}

// Raises tangent_error to the distance of S_u and S_v at the sample from those of T + q D.
void raise_tangent_error(const PatchData& patch, const Sample& a, double& tangent_error) {
  const auto& D = patch.corners.D;
  const dvec3 at = weigh(a.w, D);
  max_propagating_nan(tangent_error, glm::length(at * a.gradient.x + (D[1] - D[0]) * a.e));
  max_propagating_nan(tangent_error, glm::length(at * a.gradient.y + (D[2] - D[0]) * a.e));
}

// Whether sigma may be nonsmooth over a sub-triangle, as far as so many divisions tell.
bool may_be_nonsmooth_over(const PatchData& patch, const SubTriangle& sub_triangle, int divisions) {
  if (sphere_is_smooth(patch.corners, corner_weights(sub_triangle))) return false;
  if (divisions == 0) return true;
  const auto quarters = quarter(sub_triangle);
  return std::any_of(quarters.begin(), quarters.end(), [&](const SubTriangle& piece) {
    return may_be_nonsmooth_over(patch, piece, divisions - 1);
  });
}

void add_pieces(const PatchData& patch, const SubTriangle& sub_triangle, int divisions,
                std::vector<RangedPiece>& pieces) {
  if (divisions > 0) {
    for (const SubTriangle& piece : quarter(sub_triangle)) {
      add_pieces(patch, piece, divisions - 1, pieces);
    }
    return;
  }
  const CornerWeights weights = corner_weights(sub_triangle);
  const PatchCorners corners = corners_of(patch.corners, weights);
  pieces.push_back({weights, corners, sphere_sigma_range(patch.corners, weights, corners)});
}

// A proven bound on the distance of S from T + q D over a piece: the ranges of sigma and of q, from
// its Bernstein coefficients, give that of sigma - q.
double proven_position_error(const DisplacementQuadratic& q, const RangedPiece& piece) {
  if (!piece.sigma) return kInfinity;
  const CornerWeights& w = piece.weights;
  Interval quadratic = q.blossom(w[0], w[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    quadratic = hull(quadratic, q.blossom(w[i], w[i]));
    quadratic = hull(quadratic, q.blossom(w[i], w[(i + 1) % 3]));
  }
  const Interval e = *piece.sigma - quadratic;
  return std::max(-e.lo, e.hi) * longest_of(piece.corners.D);
}

// An error bound, or UNBOUNDED if nothing is known: if it is a NaN or infinite.
double known_error(double error) {
  return error < in_double::UNBOUNDED ? error : in_double::UNBOUNDED;
}

// The fit for a subpatch of the sphere surface that may be nonsmooth: only the position error is
// bounded. `rounded`: the position error from rounding the quadratic.
Fit nonsmooth_fit(const PatchData& patch, const SubTriangle& sub_triangle, Fit fit,
                  double rounded) {
  add_pieces(patch, in_double::with_overlap(sub_triangle), kProofDivisions, fit.pieces);
  double position_error = 0.0;
  for (const RangedPiece& piece : fit.pieces) {
    max_propagating_nan(position_error, proven_position_error(fit.q, piece));
  }
  fit.position_error = known_error(position_error + rounded);
  fit.tangent_error = in_double::UNBOUNDED;
  fit.gradient_lipschitz = NONSMOOTH;
  return fit;
}

}  // namespace

bool may_be_nonsmooth(const PatchData& patch, const SubTriangle& sub_triangle) {
  return patch.shape.surface == SURFACE_SPHERE &&
         may_be_nonsmooth_over(patch, in_double::enlarged(sub_triangle, CONE_MARGIN),
                               kProofDivisions);
}

Fit fit_subpatch(const PatchData& patch, const SubTriangle& sub_triangle) {
  const bool cubic = in_double::is_cubic(patch.shape);
  Fit fit;
  // A cubic patch has its sigma for quadratic, with the coefficients that the kernels compute.
  fit.q = cubic ? DisplacementQuadratic{dvec3(0.0), patch.bulges * 0.5}
                : through(sub_triangle, [&](const dvec3& w) {
                    return in_double::displacement(patch.shape, patch.tri, w);
                  });
  // Where directions cancel out there is no sigma for a quadratic to follow. The errors tell.
  // Written so that a NaN is no coefficient.
  const double square = glm::dot(fit.q.corner, fit.q.corner) + glm::dot(fit.q.edge, fit.q.edge);
  const double most = 0.1 * static_cast<double>(LARGEST);
  if (!(square < most * most)) fit.q = DisplacementQuadratic{};
  const double longest_D = longest_of(patch.corners.D);
  // A coefficient is rounded to single precision, and a product with two weights rounds twice. The
  // kernels' certificates depend on it, and with them a root's last digits.
  constexpr double rounding = 2e-7;
  static_assert(rounding >= gamma_single(3));
  const dvec3 size = glm::max(glm::abs(fit.q.corner), glm::abs(fit.q.edge));
  const double rounded = rounding * std::max({size.x, size.y, size.z}) * longest_D;
  if (cubic) {
    fit.position_error = rounded;
    fit.tangent_error = rounded;
    return fit;
  }
  if (may_be_nonsmooth(patch, sub_triangle)) {
    return nonsmooth_fit(patch, sub_triangle, fit, rounded);
  }
  const SubTriangle large = in_double::with_overlap(sub_triangle);
  const std::vector<Sample> samples = samples_of(patch, large, fit.q);
  for (const Sample& a : samples) {
    const double D = glm::length(weigh(a.w, patch.corners.D));
    max_propagating_nan(fit.position_error, D * std::abs(a.e));
    raise_tangent_error(patch, a, fit.tangent_error);
  }
  max_propagating_nan(fit.gradient_lipschitz,
                      steepest_change(samples) / std::abs(large.size) * longest_D);
  const auto widened = [&](double error) { return known_error(error * kBetweenSamples + rounded); };
  fit.position_error = widened(fit.position_error);
  fit.tangent_error = widened(fit.tangent_error);
  fit.gradient_lipschitz = widened(fit.gradient_lipschitz);
  return fit;
}

double tangent_error_over(const PatchData& patch, const SubTriangle& large, const Fit& fit) {
  if (fit.gradient_lipschitz == 0.0) return fit.tangent_error;
  double most = 0.0;
  for (const Sample& a : samples_of(patch, large, fit.q)) raise_tangent_error(patch, a, most);
  return std::max(kBetweenSamples * most, fit.tangent_error);
}

}  // namespace trisect
