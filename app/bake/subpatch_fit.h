// The quadratic that stands for sigma over a subpatch, and how far the surface is from it, in
// double precision. The functions have no state and may be called from several threads.
//
// subpatch_fit.cpp is compiled with the SLP vectorizer, which the rest of the program must not have
// (CMakeLists.txt): without it the sphere surface takes half as long again to bake. So nothing here
// rounds a number to single precision.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "app/base/interval.h"
#include "app/surface/control_net.h"
#include "app/surface/patch_range.h"
#include "app/surface/surface_double.h"

namespace trisect {

struct PatchData {
  in_double::Shape shape;
  in_double::Triangle tri;
  Patch corners;
  glm::dvec3 bulges;  // edge_bulges as the kernels see them, in single precision
};

// A piece of a subpatch, and the range of sigma over it, if one is known.
struct RangedPiece {
  CornerWeights weights;
  PatchCorners corners;
  std::optional<Interval> sigma;
};

struct Fit {
  DisplacementQuadratic q;
  double position_error = 0.0;      // S is no farther from T + q D, a length
  double tangent_error = 0.0;       // S_u and S_v are no farther from those of T + q D
  double gradient_lipschitz = 0.0;  // SubpatchBounds::gradient_lipschitz
  std::vector<RangedPiece> pieces;  // of a subpatch that may be nonsmooth, its overlap included
};

// Whether samples may not show how sigma changes over a subpatch and where its cone goes beyond it.
bool may_be_nonsmooth(const PatchData& patch, const in_double::SubTriangle& sub_triangle);

// For the subpatch over a sub-triangle and its overlap with the neighbours. An error of which
// nothing is known is UNBOUNDED.
Fit fit_subpatch(const PatchData& patch, const in_double::SubTriangle& sub_triangle);

// Fit::tangent_error over a larger sub-triangle.
double tangent_error_over(const PatchData& patch, const in_double::SubTriangle& large,
                          const Fit& fit);

}  // namespace trisect
