// What a model's curved surfaces will be like.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "app/mesh/mesh.h"
#include "app/surface/surface_choice.h"

namespace trisect {

// Displacements and cracks are over the model's radius. What is looked for at points of a patch is
// looked for at 15 of them, and along an edge at 9.
struct SurfaceFacts {
  SurfaceChoice choice;
  std::size_t parts = 0;         // subpatches that are searched
  std::size_t device_bytes = 0;  // without a tree
  std::size_t folding = 0;       // patches whose normal turns to the back somewhere
  double largest_displacement = 0.0;
};

struct ModelFacts {
  glm::dvec3 low;  // of the bounding box
  glm::dvec3 high;
  double radius = 0.0;        // of the vertices about the box's centre
  double largest_lean = 0.0;  // degrees between a corner's normal and its face's
  std::size_t leaning = 0;    // corners whose normal leans by more than kSteepLean
  SurfaceFacts surface;       // in the normal shell
  // Of phong in the height shell.
  std::size_t without_height_shell = 0;  // triangles that have no surface there
  double largest_crack = 0.0;            // between two triangles along their common edge
};

constexpr double kSteepLean = 60.0;

// surface: SURFACE_PHONG or SURFACE_SPHERE. Throws InputError as bake() does, Interrupted.
ModelFacts facts_of(const Mesh& mesh, uint surface);

// How far the phong surface in the normal shell, with this alpha, can be from that of positions up
// to `position` away and unit normals up to `normal` away: with E an edge and dN the difference of
// its normals, |s_ij| changes by at most c = |alpha| (2 position (|dN| + 2 normal) + 2 normal |E|),
// the displacement by c / 3, for the sum of w_i w_j over the edges is 1/3 at most, and the shell's
// direction, which is no longer than 1, by `normal`. A length; infinite if one of the two is.
double moved_by_rounding(const Mesh& mesh, double alpha, double position, double normal);

}  // namespace trisect
