// The edges of triangles that share vertices.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace trisect {

// A triangle's side. An edge is a pair of vertices.
struct Side {
  std::pair<uint32_t, uint32_t> edge;  // lower vertex first
  uint32_t triangle;
  uint8_t corner;  // at which it begins
  bool forward;    // from the lower vertex to the other
};

// All sides of triangles 0 to count - 1, those of the same edge one after the other in the order of
// the triangles. vertices_of(t): the three vertices of triangle t.
template <typename VerticesOf>
std::vector<Side> sides_of(std::size_t count, VerticesOf&& vertices_of) {
  std::vector<Side> sides;
  sides.reserve(count * 3);
  for (uint32_t t = 0; t < count; ++t) {
    const auto& vertices = vertices_of(t);
    for (uint8_t i = 0; i < 3; ++i) {
      const uint32_t from = vertices[i];
      const uint32_t to = vertices[(i + 1) % 3];
      sides.push_back({std::minmax(from, to), t, i, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::pair(a.edge, std::pair(a.triangle, a.corner)) <
           std::pair(b.edge, std::pair(b.triangle, b.corner));
  });
  return sides;
}

// Calls with_edge(sides) for the sides of each edge.
template <typename WithEdge>
void for_edges(const std::vector<Side>& sides, WithEdge&& with_edge) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].edge == sides[begin].edge) ++end;
    with_edge(std::span(sides).subspan(begin, end - begin));
  }
}

}  // namespace trisect
