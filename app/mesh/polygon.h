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
// plane closest to its Newell normal. Returns indices into `corners`, which must be three or more.
//
// Up to 512 corners the ears are cut in their order around the polygon; corners that may lie inside
// one are found by a grid. Of more corners each is looked at again only after what kept it from
// being an ear has changed, and a tree finds what lies inside. A polygon that crosses itself is
// still cut into that many triangles. After most_triangulation_steps() the corners that turn the
// polygon's way are cut off without a look at what lies inside: no polygon takes longer, and none
// that does not cross itself is known to come near it.
//
// steps: if not null, set to how many corners and boxes of the tree were looked at.
std::vector<std::array<uint32_t, 3>> triangulate(std::span<const glm::dvec3> corners,
                                                 uint64_t* steps = nullptr);

// The bound for more than 512 corners: a constant times n log n.
uint64_t most_triangulation_steps(std::size_t corners);

}  // namespace trisect
