// The choices, beside those of the scene, that a tracer's kernels are specialised for. What a
// choice leaves out is not compiled in.
#pragma once

#include "app/surface/shared.h"

namespace trisect {

// The acceleration: how the candidates for a ray are found. All but `list` need the robust solver.
enum class Accel {
  list,      // every subpatch (bisection: every triangle) whose bounding ball the ray meets
  tiles,     // the subpatches whose projections overlap the pixel's tile: primary rays only
  bvh,       // by the scene's BVH over the subpatches' bounding boxes
  rayquery,  // by the device's own acceleration structure over these boxes (VK_KHR_ray_query); the
             // scene's BVH too, for rays that take too long
};

// Names as on the command line and in JSON.
constexpr const char* solver_name(uint solver) {
  return solver == SOLVER_BISECT ? "bisect" : "robust";
}
constexpr const char* accel_name(Accel accel) {
  switch (accel) {
    case Accel::tiles:
      return "tiles";
    case Accel::bvh:
      return "bvh";
    case Accel::rayquery:
      return "rayquery";
    default:
      return "list";
  }
}

struct KernelChoice {
  uint solver = SOLVER_ROBUST;  // SOLVER_ROBUST needs the scene's subpatches
  bool aovs = false;            // frames have PixelAovs beside the colour
  bool counts = false;          // evaluations and candidates are counted, in the AOVs
  Accel accel = Accel::list;
  // Shadow rays are traced too; needs the robust solver. With Accel::tiles they traverse the
  // scene's BVH, because only rays through the eye have a tile.
  bool shadows = false;
  // For measurements, with Accel::tiles: subpatches are culled by their bounding balls, as in the
  // thesis, instead of by their control points.
  bool balls = false;

  bool operator==(const KernelChoice&) const = default;

  // Shadow rays start from what the AOVs say was hit.
  [[nodiscard]] bool writes_aovs() const { return aovs || shadows; }
};

}  // namespace trisect
