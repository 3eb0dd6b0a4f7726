// Where the parts of a scene's patches are.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "app/bake/bake.h"

namespace trisect {

// In single precision, rounded outward.
struct SubpatchBox {
  glm::vec3 lo;
  glm::vec3 hi;
};

// For each of the scene's cages a box that contains the part, enlarged by OVERLAP, and BVH_SLACK of
// the scene's extent around it; for a group of parts nothing of use.
std::vector<SubpatchBox> subpatch_boxes(const BakedScene& scene);

}  // namespace trisect
