// What a model file holds: polygons, as it wrote them. build_mesh() makes a mesh of it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace trisect {

// A corner of a polygon: zero-based indices into the arrays of PolygonModel; no_normal where the
// file gives none.
struct PolygonCorner {
  static constexpr uint32_t no_normal = 0xffffffffU;
  uint32_t position;
  uint32_t normal;
};

// The polygons of all groups and objects of a file, in file order.
struct PolygonModel {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;     // as in the file, not normalised
  std::vector<PolygonCorner> corners;  // of all polygons, one polygon after the other
  std::vector<uint32_t> sizes;         // number of corners of each polygon, three or more
  // Of each polygon: normals that are made are smooth between polygons of the same group; 0 is a
  // group of one polygon. Empty: all polygons are in one.
  std::vector<uint32_t> smoothing_groups;
  // What was left out, or is not taken as the file has it: phrases for a person, "3 lines left
  // out".
  std::vector<std::string> notes;
};

}  // namespace trisect
