// Normals for corners to which a model gives none.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "app/mesh/polygon_model.h"

namespace trisect {

// A triangle of a model on its way into a mesh.
struct ModelTriangle {
  std::array<uint32_t, 3> vertex;  // of its corners, where vertices at the same place are one
  std::array<uint32_t, 3> normal;  // into PolygonModel::normals, or PolygonCorner::no_normal
  uint32_t smoothing_group;
};

// The face normal with twice the triangle's area as its length.
inline glm::dvec3 area_vector(const std::array<glm::dvec3, 3>& p) {
  return glm::cross(p[1] - p[0], p[2] - p[0]);
}

inline std::array<glm::dvec3, 3> points_of(const std::array<uint32_t, 3>& vertex,
                                           const std::vector<glm::dvec3>& positions) {
  return {positions[vertex[0]], positions[vertex[1]], positions[vertex[2]]};
}

// Angle-weighted normals for all corners, as build_mesh() describes them.
struct MadeNormals {
  std::vector<glm::dvec3> normals;  // unit length; corners around a vertex share those that agree
  std::vector<uint32_t> of_corner;  // of corner i of triangle t: the normal's number at 3 t + i
};

// crease_cosine: of the crease angle; less than -1 without one. Pure.
MadeNormals make_normals(const std::vector<ModelTriangle>& triangles,
                         const std::vector<glm::dvec3>& positions, double crease_cosine);

}  // namespace trisect
