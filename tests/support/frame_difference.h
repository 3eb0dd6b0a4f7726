// How far two frames of the same scene are apart.
#pragma once

#include <cstddef>

#include "app/frame/frame.h"

namespace trisect::test {

struct FrameDifference {
  bool same_size = false;
  std::size_t hit_mismatches = 0;    // hit in one, missed in the other
  std::size_t patch_mismatches = 0;  // hit in both, on different triangles
  double depth = 0.0;                // largest |difference| of Z where both hit
  double normal_degrees = 0.0;       // largest angle between shading or between geometric normals
  double weights = 0.0;              // largest |difference| of U or V on the same triangle
  double color = 0.0;                // largest |difference| of R, G or B
};

FrameDifference difference(const Frame& a, const Frame& b);

}  // namespace trisect::test
