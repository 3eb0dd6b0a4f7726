// The nearest point of flat triangles to any point.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "app/bench/embree_triangles.h"
#include "app/tessellation/flat_mesh.h"

namespace trisect::bench {

// A point of a flat triangle, and how far off it is.
struct NearPoint {
  double distance = 0.0;
  uint32_t triangle = 0;
  glm::dvec3 weights{0.0};  // of the triangle's corners
};

// Pure.
NearPoint nearest_of_triangle(const FlatMesh& mesh, uint32_t triangle, const glm::dvec3& point);

class NearestPoint {
 public:
  // mesh: one triangle at least; it must outlive this object. Throws OutOfMemory.
  explicit NearestPoint(const FlatMesh& mesh);

  // In double precision; of several at the same distance the first. Thread-safe.
  [[nodiscard]] NearPoint to(const glm::dvec3& point) const;

  [[nodiscard]] const FlatMesh& mesh() const { return mesh_; }

 private:
  const FlatMesh& mesh_;
  // The tree's numbers are about the middle of the mesh.
  glm::dvec3 middle_{0.0};
  double extent_ = 0.0;
  EmbreeTriangles triangles_;
};

}  // namespace trisect::bench
