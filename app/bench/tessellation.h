// Subdivision of curved triangles into flat ones, as other renderers draw them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "app/bake/bake.h"

namespace trisect::bench {

// Every triangle of a scene as n x n flat ones with their corners on the surface.
struct Tessellation {
  uint32_t n = 1;
  std::vector<glm::vec3> vertices;    // (n + 1) (n + 2) / 2 of every triangle
  std::vector<glm::uvec3> triangles;  // n^2 of every triangle
};

Tessellation tessellate(const BakedScene& scene, uint32_t n);

// The barycentric weights, in its patch, of a point of flat triangle `index` of the patch's n^2,
// where u and v are the weights of that triangle's second and third corner.
glm::vec3 weights_in_patch(uint32_t n, uint32_t index, float u, float v);

// The largest distance of the surface from the flat triangles along their normals, sampled at their
// centroids and the midpoints of their edges, over the scene's radius.
double tessellation_error(const BakedScene& scene, uint32_t n);

// An n, close to the least, whose tessellation_error() is at most `error`; at most `most`.
uint32_t divisions_for(const BakedScene& scene, double error, uint32_t most);

// The same, with at most sixteen million flat triangles, which fit into 24 GiB of memory.
uint32_t affordable_divisions_for(const BakedScene& scene, double error);

}  // namespace trisect::bench
