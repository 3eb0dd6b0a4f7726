// Proven ranges of a patch's tangents over a sub-triangle, along given axes.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "app/base/interval.h"
#include "app/surface/patch_range.h"
#include "app/surface/surface_choice.h"

namespace trisect {

// Ranges of the derivatives of S by the weights 1 and 2 within a sub-triangle, the weight 0 giving
// way, along each of three axes.
struct TangentRanges {
  std::array<Interval, 3> u;
  std::array<Interval, 3> v;
};

// Between any two points of the sub-triangle, whose weights within differ by (du, dv), S changes
// along axis k by a number of u[k] times du plus one of v[k] times dv: the mean value theorem, for
// surfaces that are not differentiable everywhere that of Lebourg for generalised gradients (Clarke
// 1983, "Optimization and Nonsmooth Analysis", theorem 2.3.7). Nothing where no bound is known.
//
// Roundings included, also of the axes' products; they need not be of unit length. The sub-triangle
// may reach beyond the patch. Pure.
//
// flat:   constant.
// phong, normal shell: the control vectors of the cubic's derivatives.
// phong, height shell: sigma = alpha D.K / |D|^2 with quadratic K and linear D, differentiated:
//         the ranges of its polynomials are those of their Bernstein coefficients.
// sphere: the ranges of what sigma changes by (sphere_change_ranges).
std::optional<TangentRanges> tangent_ranges(const SurfaceChoice& choice, const Patch& patch,
                                            const in_double::SubTriangle& sub_triangle,
                                            const std::array<glm::dvec3, 3>& axes);

}  // namespace trisect
