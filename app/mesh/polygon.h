// Triangulation of a polygon.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace trisect {

// Cuts a simple polygon, convex or not, planar or nearly so, into corners.size() - 2 triangles of
// the same orientation, by ear clipping (Meisters 1975, "Polygons have ears") in the coordinate
// plane closest to its Newell normal. Corners that may lie inside an ear are found by a grid, so
// that the time grows little faster than the number of corners unless most ears are as wide as the
// polygon. A polygon that crosses itself is still cut into that many
// triangles. Returns indices into `corners`, which must be three or more.
std::vector<std::array<uint32_t, 3>> triangulate(std::span<const glm::dvec3> corners);

}  // namespace trisect
