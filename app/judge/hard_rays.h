// Lists of rays on which ray tracers fail, for a model, in its own coordinates and in single
// precision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "app/bake/bake.h"
#include "app/judge/ray_file.h"

namespace trisect {

struct RayKind {
  const char* name;
  const char* what;
};

// Lengths are in radii, half the diagonal of the model's bounding box.
inline constexpr std::array<RayKind, 8> kRayKinds{{
    {"random", "at random points of the surface, from random directions"},
    {"vertex", "at a vertex"},
    {"edge", "at a point of an edge"},
    {"along", "along an edge, leaning to the surface by a thousandth"},
    {"grazing", "along a tangent, up to a hundredth of a radius off the surface"},
    {"far", "at random points from ten thousand radii away"},
    {"axis", "along an axis, or at a right angle to one: components of zero"},
    {"leaving", "from a point of the surface, t_min a thousandth of a radius"},
}};

// `count` rays of a kind, the same ones for the same seed. scene: baked about the origin of the
// model's coordinates (bake_about). Directions are of unit length, but for rounding. Throws
// std::out_of_range if there is no such kind. Pure.
std::vector<FileRay> hard_rays(const BakedScene& scene, std::string_view kind, std::size_t count,
                               uint32_t seed);

}  // namespace trisect
