// Bernstein coefficients over sub-triangles of what the surfaces are made of. A polynomial lies
// between the least and the most of its coefficients (Farin, "Curves and Surfaces for CAGD").
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

#include "app/surface/patch_range.h"

namespace trisect {

// Coefficients of a quadratic over a sub-triangle: at the corners, then at the edges 01 12 20.
template <typename Value>
using Quadratic = std::array<Value, 6>;

inline constexpr std::size_t kEdgeOfCorners[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

// The polar form of sum_{i<j} w_i w_j q_ij, q in the order 01 12 20. At a weight and a direction of
// weights it is half the derivative.
template <typename Value>
Value blossom_of(const std::array<Value, 3>& q, const glm::dvec3& a, const glm::dvec3& b) {
  return (q[0] * (a.x * b.y + a.y * b.x) + q[1] * (a.y * b.z + a.z * b.y) +
          q[2] * (a.x * b.z + a.z * b.x)) *
         0.5;
}

// The same quadratic over a sub-triangle: its blossom at pairs of corners.
template <typename Value>
Quadratic<Value> quadratic_over(const CornerWeights& w, const std::array<Value, 3>& q) {
  return {blossom_of(q, w[0], w[0]), blossom_of(q, w[1], w[1]), blossom_of(q, w[2], w[2]),
          blossom_of(q, w[0], w[1]), blossom_of(q, w[1], w[2]), blossom_of(q, w[2], w[0])};
}

// The quadratic that is the product of two linear functions, given at the corners.
template <typename A, typename B, typename Product>
auto quadratic_of(const std::array<A, 3>& a, const std::array<B, 3>& b, const Product& times) {
  using Result = decltype(times(a[0], b[0]));
  Quadratic<Result> coefficients{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    coefficients[i] = times(a[i], b[i]);
    coefficients[i + 3] = (times(a[i], b[j]) + times(a[j], b[i])) * 0.5;
  }
  return coefficients;
}

// The ten coefficients of a quadratic times a linear function.
template <typename Value, typename Linear, typename Product>
auto cubic_of(const Quadratic<Value>& q, const std::array<Linear, 3>& l, const Product& times) {
  using Result = decltype(times(q[0], l[0]));
  std::array<Result, 10> coefficients{};
  std::size_t next = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    coefficients[next++] = times(q[i], l[i]);
    for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) {
      coefficients[next++] =
          (times(q[i], l[j]) + times(q[kEdgeOfCorners[i][j]], l[i]) * 2.0) * (1.0 / 3.0);
    }
  }
  coefficients[next] = (times(q[3], l[2]) + times(q[4], l[0]) + times(q[5], l[1])) * (1.0 / 3.0);
  return coefficients;
}

// K of Phong Tessellation's offset, a quadratic: sum_{i<j} w_i w_j V_ij with
// V_ij = (E_ij.N_j) N_j - (E_ij.N_i) N_i, in the order 01 12 20.
std::array<glm::dvec3, 3> phong_offset_products(const Patch& patch);

}  // namespace trisect
