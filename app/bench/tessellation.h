// Curved triangles cut into flat ones, as others draw them.
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

// The weights in its triangle of a point that has weights u and v of the second and third corner of
// flat triangle `index` of its n^2.
glm::vec3 weights_in_patch(uint32_t n, uint32_t index, float u, float v);

// How far the surface is off the flat triangles along their normals, the most over their middles
// and those of their edges, over the scene's radius.
double tessellation_error(const BakedScene& scene, uint32_t n);

// The least n that brings the error down to `error`, at most `most`.
uint32_t divisions_for(const BakedScene& scene, double error, uint32_t most);

// The same, with at most sixteen million flat triangles, which 24 GiB bear.
uint32_t affordable_divisions_for(const BakedScene& scene, double error);

}  // namespace trisect::bench
