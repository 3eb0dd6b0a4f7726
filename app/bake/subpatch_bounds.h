// The bounds of a scene's subpatches: what lets the robust solver prove that a ray misses a patch,
// or meets it once at most.
#pragma once

#include <optional>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/surface/shared.h"

namespace trisect {

// The bounds for scene.triangles, in their order: none for one that has no surface; one for a patch
// whose sigma is close to a quadratic; otherwise one for the whole, with `skip` set, followed by
// those of its four quarters, each of them divided in the same way, depth first. Position and
// tangent errors are proven for Phong Tessellation in the normal shell (roundings only) and, the
// position error, for nonsmooth subpatches; for others they come from samples with a margin. Works
// on all cores; the result does not depend on their number.
std::vector<SubpatchBounds> bake_subpatches(const BakedScene& scene);

// bake() and bake_subpatches().
BakedScene bake_with_subpatches(const Mesh& mesh, const SurfaceChoice& choice);

// The same, telling `progress` now and then of how many of the mesh's triangles the subpatches are
// made; nothing if it says stop.
std::optional<BakedScene> bake_with_subpatches(const Mesh& mesh, const SurfaceChoice& choice,
                                               const Progress& progress);

// Whether some patch is divided into subpatches.
bool has_divided_patches(const BakedScene& scene);

// Whether the gradient of sigma may jump over some subpatch.
bool has_nonsmooth(const BakedScene& scene);

}  // namespace trisect
