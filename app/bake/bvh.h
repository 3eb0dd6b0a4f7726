// A bounding volume hierarchy over a scene's subpatches, to find those that a ray may meet.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/bake/bake.h"
#include "app/bake/subpatch_boxes.h"
#include "app/surface/shared.h"

namespace trisect {

// The tree over the scene's subpatches, of which there must be one at least, by Embree's builder
// (surface area heuristic, nodes of eight). The children of a node are in the order of octants
// (Ylitie, Karras & Laine 2017, "Efficient incoherent ray traversal on GPUs through compressed wide
// BVHs", section 3.2), so that a ray may take them front to back. A node comes before those below
// it. Embree builds on all cores and does not promise the same tree every time; the hits of rays do
// not depend on its shape. Throws InputError if there are more subpatches than a tree can hold,
// std::runtime_error if Embree fails.
std::vector<BvhNode> build_bvh(const BakedScene& scene);

// other.bvh with its boxes refitted to the scene's subpatches, in a fraction of the time of a
// build. Nothing if there is no such tree or if the two scenes' patches are not divided in the same
// way. Meant for a change of alpha or of the surface of one mesh. Pure.
std::optional<std::vector<BvhNode>> refitted_bvh(const BakedScene& scene, const BakedScene& other);

inline bool has_child(const BvhNode& node, uint32_t k) {
  return (node.children >> k & 1U) != 0;
}

// The box of child k, which must exist, as the kernels compute it; it contains that of the
// subpatch, or those of the child's children.
SubpatchBox child_box(const BvhNode& node, uint32_t k);

}  // namespace trisect
