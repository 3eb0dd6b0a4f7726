// How far one surface is from another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "app/base/keep_going.h"
#include "app/base/quantiles.h"
#include "app/bench/nearest_point.h"
#include "app/tessellation/flat_mesh.h"

namespace trisect::bench {

// Flat triangles to which distances are measured: with the nearest point to any, and the triangle
// on the other side of each edge.
class Target {
 public:
  static constexpr uint32_t kNone = ~0U;

  // mesh: as NearestPoint takes it.
  explicit Target(const FlatMesh& mesh);

  [[nodiscard]] const FlatMesh& mesh() const { return nearest_.mesh(); }
  [[nodiscard]] NearPoint nearest(const glm::dvec3& point) const { return nearest_.to(point); }

  // A triangle that has the edge from corner k to the next one the other way round; kNone if there
  // is none. Vertices at the same place count as one.
  [[nodiscard]] uint32_t across(uint32_t triangle, glm::length_t k) const {
    return across_[triangle][k];
  }

 private:
  NearestPoint nearest_;
  std::vector<glm::uvec3> across_;
};

// The distance of the point of `from` that is farthest from the target: at least `found`, which is
// that of a point, and at most `bound`.
struct LargestDistance {
  double found = 0.0;
  double bound = 0.0;
};

// Looks for it until `bound` is no more than a hundredth and `resolution`, a length, above `found`.
// Triangles of `from` are bounded as follows, and divided in four where that is not enough: half a
// million of them at once, those with the largest bounds, and sixteen times. Where even that is not
// enough `bound` is larger.
//
// 1. The distance to one triangle of the target is convex, so over a triangle it is largest at a
//    corner.
// 2. Over a triangle T look along its normal n. Beginning with a triangle of the target that
//    overlaps T, go to the neighbour across every edge that overlaps T. If all that are met face
//    the same way along n, and no edge that overlaps T is without a neighbour, they cover T. What
//    they cover of it is closed; and it is open: around a point of an edge both triangles cover
//    their side, and around a vertex going from neighbour to neighbour always turns the same way
//    until it has gone around. Then no point of T is farther from the target than the largest of
//    their heights over T. T is taken a billionth smaller than it is, and that is added.
//
// Roundings of double precision are not bounded but for those of T's normal. Works on all cores;
// the result does not depend on their number. Nothing if progress said stop.
std::optional<LargestDistance> largest_distance(const FlatMesh& from, const Target& to,
                                                double resolution,
                                                const FractionProgress& progress = {});

// Distances and directions of points that are spread evenly, by chance, over a surface.
struct Samples {
  Quantiles distance;
  double rms = 0.0;           // of the distances
  Quantiles shading_degrees;  // between the interpolated normals of both
  Quantiles face_degrees;     // between the triangle's normal and the target's interpolated one
};

std::optional<Samples> sampled(const FlatMesh& from, const Target& to, std::size_t count,
                               const FractionProgress& progress = {});

}  // namespace trisect::bench
