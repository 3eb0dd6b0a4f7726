// The models with a formula. All are given with y up and their normals exact.
#pragma once

#include "assets/generator/model.h"

namespace trisect::assets {

// The unit sphere: an icosahedron, each triangle divided in four `divisions` times (20, 80, 320,
// ... triangles).
Model sphere(int divisions);

// About the y axis: radius 1 to the middle of a tube of radius 0.4; 256 triangles.
Model torus();

// Radius 0.5, a cylinder of length 1 along y between two half balls; 224 triangles.
Model capsule();

// 2 x 2 x 2 about the origin, every face with its own normal; 12 triangles.
Model cube();

// y = (x^2 - z^2) / 2 over the square of side 2; 32 triangles.
Model saddle();

// A wavy relief in the x-y plane that looks toward z, 80 triangles: like the thesis's model Fresko,
// which is lost.
Model relief();

}  // namespace trisect::assets
