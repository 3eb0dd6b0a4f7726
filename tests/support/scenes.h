// Models and patches for tests.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <random>
#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/mesh/mesh.h"
#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"

namespace trisect::test {

// The models in assets/, without the ending.
const std::vector<std::string>& asset_names();

std::string asset_path(const std::string& name);

Mesh load_asset(const std::string& name);

// The mesh with every hole in it filled by a fan about its middle. Along the border the fan has the
// mesh's own normals. A mesh without holes stays as it is.
Mesh without_holes(Mesh mesh);

// Every surface in every shell, and one that alpha takes far from the triangle.
inline constexpr std::array kSurfaceChoices{SurfaceChoice{SURFACE_FLAT, 0.0, SHELL_NORMAL},
                                            SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_NORMAL},
                                            SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_HEIGHT},
                                            SurfaceChoice{SURFACE_PHONG, -2.0, SHELL_HEIGHT},
                                            SurfaceChoice{SURFACE_SPHERE, 0.0, SHELL_NORMAL},
                                            SurfaceChoice{SURFACE_SPHERE, 0.0, SHELL_HEIGHT}};

// A mesh of one triangle.
Mesh one_triangle(const std::array<glm::dvec3, 3>& positions,
                  const std::array<glm::dvec3, 3>& normals);

// Corners in the unit cube; unit normals up to `spread` degrees off the face normal.
struct RandomPatch {
  std::array<glm::dvec3, 3> positions;
  std::array<glm::dvec3, 3> normals;
};
RandomPatch random_patch(std::mt19937_64& random, double spread);

// So many of them beside each other, with normals that nearly cancel out at a point within, about
// which the sphere surface is nonsmooth.
Mesh wild_patches(int count);

// The weights of a random point, each point of a triangle as likely as any other.
glm::dvec3 random_weights(std::mt19937_64& random);

// All weights with denominators n, (n + 1) (n + 2) / 2 of them; without the border if `interior`.
std::vector<glm::dvec3> weight_grid(int n, bool interior = false);

}  // namespace trisect::test
