// The models with a formula. All are given with y up and their normals exact. finer: into so many
// parts each edge is divided.
#pragma once

#include "assets/generator/model.h"

namespace trisect::assets {

// The unit sphere: an icosahedron, each triangle divided in four `divisions` times (20, 80, 320,
// ... triangles).
Model sphere(int divisions);

// About the y axis: radius 1 to the middle of a tube of radius 0.4; 256 finer^2 triangles.
Model torus(int finer = 1);

// Radius 0.5, a cylinder of length 1 along y between two half balls; 256 finer^2 - 32 finer
// triangles.
Model capsule(int finer = 1);

// 2 x 2 x 2 about the origin, every face with its own normal; 12 triangles.
Model cube();

// y = (x^2 - z^2) / 2 over the square of side 2; 32 finer^2 triangles.
Model saddle(int finer = 1);

// A wavy relief in the x-y plane that looks toward z, 80 finer^2 triangles: like the thesis's model
// Fresko, which is lost.
Model relief(int finer = 1);

}  // namespace trisect::assets
