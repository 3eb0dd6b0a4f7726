// Bounding boxes of a scene's subpatches.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "app/bake/bake.h"

namespace trisect {

// Axis-aligned, relative to the scene's origin, in single precision, rounded outward.
struct SubpatchBox {
  glm::vec3 lo;
  glm::vec3 hi;
};

// For each of scene.subpatches a box that contains its surface, enlarged by OVERLAP, with a margin
// of BVH_SLACK times the scene's radius. Of a divided patch (`skip` not 0) the box of the whole is
// not to be used. Works on all cores; the result does not depend on their number.
std::vector<SubpatchBox> subpatch_boxes(const BakedScene& scene);

}  // namespace trisect
