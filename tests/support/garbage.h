// Scenes, parameters and rays whose numbers are garbage, and whose integers are in order.
#pragma once

#include <random>
#include <vector>

#include "app/bake/bake.h"
#include "app/surface/shared.h"

namespace trisect::test {

// Which numbers are garbage.
enum class Garbage {
  positions,
  normals,
  other_of_triangle,
  bounds,
  errors,
  tree,
  params,
  rays,
  all
};
inline constexpr Garbage kAllGarbage[] = {
    Garbage::positions, Garbage::normals, Garbage::other_of_triangle,
    Garbage::bounds,    Garbage::errors,  Garbage::tree,
    Garbage::params,    Garbage::rays,    Garbage::all};
const char* garbage_name(Garbage garbage);

// Two patches, of whose subpatches but two are kept, and a tree over these: a ray may take millions
// of evaluations for each.
BakedScene two_subpatches(const SurfaceChoice& choice);

// Any bits: a NaN, an infinity, a denormal, a huge, a tiny or an ordinary number.
float garbage_number(std::mt19937& random);

// Replaces about two in three of the numbers that are to be garbage. The scene's own members beside
// its lists stay, for the host computes with them.
void spoil(Garbage garbage, std::mt19937& random, BakedScene& scene);
void spoil(Garbage garbage, std::mt19937& random, TraceParams& params);
void spoil(Garbage garbage, std::mt19937& random, std::vector<CastRay>& rays);

// The most evaluations of the surface for a ray by the robust solver. A shadow ray takes as many.
uint64_t most_evaluations(const BakedScene& scene);

}  // namespace trisect::test
