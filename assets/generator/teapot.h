// Newell's teapot.
#pragma once

#include "assets/generator/model.h"

namespace trisect::assets {

// How finely the patches are divided. A patch of revolution covers a quarter turn, one of the
// handle or the spout half of the tube.
struct TeapotDivisions {
  int quarter;                      // along a quarter turn
  int rim, upper_body, lower_body;  // down the profile
  int knob, lid, bottom;
  int handle_around, handle_along;
  int spout_around, spout_along;
};

constexpr TeapotDivisions kTeapot304{2, 2, 2, 3, 3, 2, 2, 2, 3, 2, 3};
constexpr TeapotDivisions kTeapot1016{4, 2, 4, 4, 3, 3, 2, 3, 9, 4, 8};
constexpr TeapotDivisions kTeapot4000{8, 4, 8, 8, 6, 6, 4, 6, 18, 7, 16};

// Every number of them so many times.
TeapotDivisions divided(const TeapotDivisions& divisions, int times);

// The 32 bicubic Bezier patches with y up, standing on y = 0, with their exact normals. The parts
// (lid, rim and body with bottom, handle, spout) are open and only touch or interpenetrate, as
// Newell designed them.
Model teapot(const TeapotDivisions& divisions);

}  // namespace trisect::assets
