// A tree over the boxes of a scene's parts, to find those that a ray may meet.
#pragma once

#include <vector>

#include "app/bake.h"
#include "app/shared.h"

namespace trisect {

// Of the scene's cages, of which there must be one, by Embree's builder (surface area heuristic,
// nodes of eight). The children of a node are put in the order of octants (Ylitie, Karras & Laine
// 2017, section 3.2), so that a ray may take them front to back. Throws InputError if it cannot
// hold them.
std::vector<BvhEntry> build_bvh(const BakedScene& scene);

}  // namespace trisect
