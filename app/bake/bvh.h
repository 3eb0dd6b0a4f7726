// A tree over the boxes of a scene's parts, to find those that a ray may meet.
#pragma once

#include <optional>
#include <vector>

#include "app/bake/bake.h"
#include "app/surface/shared.h"

namespace trisect {

// Of the scene's cages, of which there must be one, by Embree's builder (surface area heuristic,
// nodes of eight). The children of a node are put in the order of octants (Ylitie, Karras & Laine
// 2017, section 3.2), so that a ray may take them front to back. Throws InputError if it cannot
// hold them.
std::vector<BvhEntry> build_bvh(const BakedScene& scene);

// The tree of another scene with boxes around this one's parts, which takes a fraction of the time.
// Nothing if there is no such tree or its parts are not this scene's by number: after a change of
// alpha or of the surface they are, unless a patch is divided otherwise.
std::optional<std::vector<BvhEntry>> refitted_bvh(const BakedScene& scene, const BakedScene& other);

}  // namespace trisect
