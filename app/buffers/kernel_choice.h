// What a kernel does beside what the scene says; what it need not do is not compiled in.
#pragma once

#include "app/surface/shared.h"

namespace trisect {

// Which patches a ray is tried against.
enum class Accel {
  list,      // all of them
  tiles,     // those that its tile of the image touches: primary rays, robust solver
  bvh,       // those in whose boxes it comes: robust solver, needs the scene's bvh
  rayquery,  // the same by the device's own structure over the boxes, if it has ray queries
};

// As the command line and the JSON name them.
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
  uint solver = SOLVER_ROBUST;  // needs the scene's cages
  bool aovs = false;            // frames have more than colour
  bool counts = false;          // evaluations and candidates, in the AOVs
  Accel accel = Accel::list;
  // Robust solver; of accel tiles they go by the scene's bvh.
  bool shadows = false;
  // For measurements, of accel tiles: where a part can be is told by its ball, as the thesis has
  // it, and not by its control points.
  bool balls = false;

  bool operator==(const KernelChoice&) const = default;

  // Shadows start from them.
  [[nodiscard]] bool writes_aovs() const { return aovs || shadows; }
};

}  // namespace trisect
