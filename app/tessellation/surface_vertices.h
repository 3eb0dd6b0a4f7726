// Vertices on a curved surface, one for all triangles that meet there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

#include "app/bake/bake.h"
#include "app/mesh/mesh.h"
#include "app/surface/patch_range.h"
#include "app/surface/surface_double.h"

namespace trisect {

// A corner of a piece of a patch.
struct PieceCorner {
  uint32_t vertex;  // of SurfaceVertices
  glm::dvec3 weights;
};

// A vertex has a place and a normal. The two sides of a hard edge have vertices of their own, as
// their normals differ (by more than kSameNormal), at the same places: what divides one side
// divides the other. Where the curves of both sides are no farther apart than a difference of
// kSameNormal can move them, they have the same positions: then a vertex may be that much off a
// patch's own surface.
class SurfaceVertices {
 public:
  // scene: bake(mesh, ...) in the normal shell. Both must outlive the object.
  SurfaceVertices(const Mesh& mesh, const BakedScene& scene);

  // The vertex at a corner of a patch.
  uint32_t at_corner(uint32_t patch, std::size_t corner);

  // A new one within a patch.
  uint32_t within(uint32_t patch, const glm::dvec3& weights);

  // `count` vertices at even distances of the weights between two corners of a piece: made once,
  // for whoever asks first.
  struct Between {
    uint32_t first;  // the others follow
    bool reversed;   // counted from b to a
  };
  Between between(uint32_t patch, const PieceCorner& a, const PieceCorner& b, uint32_t count);

  // A number for the edge between two corners of a piece: the same for all patches that meet there
  // and for both sides of a hard edge. Two patches have a line within them in common only if they
  // have all their corners in common, and then they are the same surface.
  [[nodiscard]] uint64_t edge(const PieceCorner& a, const PieceCorner& b) const;

  // Forgets which vertices are between which: every edge that was asked for is divided.
  void forget_edges();

  [[nodiscard]] const glm::dvec3& position(uint32_t vertex) const { return positions_[vertex]; }

  // In the units of the mesh.
  [[nodiscard]] glm::dvec3 surface_point(uint32_t patch, const glm::dvec3& weights) const;

  // What has been made, by vertex; leaves the object empty.
  std::vector<glm::dvec3> take_positions() { return std::move(positions_); }
  std::vector<glm::vec3> take_normals() { return std::move(normals_); }

 private:
  uint32_t add(const glm::dvec3& position, const glm::vec3& normal, uint32_t place);
  uint32_t on_surface(uint32_t patch, const glm::dvec3& weights, uint32_t place);
  [[nodiscard]] glm::dvec3 joined(const glm::dvec3& point, uint32_t place) const;

  const Mesh& mesh_;
  const BakedScene& scene_;
  in_double::Shape shape_;
  std::vector<glm::dvec3> positions_;
  std::vector<glm::vec3> normals_;
  // The mesh's positions are the first places.
  std::vector<uint32_t> place_;           // of each vertex
  std::vector<uint32_t> next_;            // the next vertex at its place
  std::vector<uint32_t> first_of_place_;  // the first one
  // The first ones between two vertices and between two places.
  std::unordered_map<uint64_t, uint32_t> vertices_between_;
  std::unordered_map<uint64_t, uint32_t> places_between_;
};

}  // namespace trisect
