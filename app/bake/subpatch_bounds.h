// The cages of a scene's patches: what lets the robust solver prove that a ray misses a patch, or
// meets it once.
#pragma once

#include <vector>

#include "app/bake/bake.h"
#include "app/surface/shared.h"

namespace trisect {

// One cage for a patch whose sigma is close to a quadratic, several for parts of one that is not;
// in the order of the scene's triangles.
std::vector<SubpatchBounds> bake_subpatches(const BakedScene& scene);

// bake(), and the cages.
BakedScene bake_with_subpatches(const Mesh& mesh, const SurfaceChoice& choice);

// Whether some patch has several.
bool has_divided_patches(const BakedScene& scene);

// Whether some part may have a kink.
bool has_nonsmooth(const BakedScene& scene);

}  // namespace trisect
