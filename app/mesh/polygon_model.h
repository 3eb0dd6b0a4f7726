// What a model file holds: polygons, as it wrote them. build_mesh() makes a mesh of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
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

// A mesh, object or group of a file.
struct PolygonGroup {
  std::string name;   // as in the file, possibly empty
  std::size_t first;  // its first polygon; the last one is before the next group's first
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
  // Of each polygon, sRGB-encoded from 0 to 1, or no_color; empty if the file gives none.
  static constexpr glm::vec3 no_color{-1.0F};
  std::vector<glm::vec3> colors;
  // How far quantisation can have moved what the file's author had: positions, a length, and
  // normals, the length of the difference of unit vectors; for the weights of a skin as the file
  // has them. 0 if it has floats, infinite if a compression has rounded them: its step is not read.
  double position_rounding = 0.0;
  double normal_rounding = 0.0;
  // The files that were read beside the model's own, in that order.
  std::vector<std::filesystem::path> files;
  std::vector<PolygonGroup> groups;  // those that have polygons; none if the file names none
  // What was left out, or is not taken as the file has it: phrases for a person, "3 lines left
  // out".
  std::vector<std::string> notes;
};

// Makes room for so many more items, if that at least doubles them: a large part of a model is then
// not copied while it grows, and many small ones do not make room anew for each.
template <typename Item>
void make_room(std::size_t more, std::vector<Item>& items) {
  if (more >= items.size()) items.reserve(items.size() + more);
}

// How normals change where positions change by m: the inverse transposed, times the determinant's
// size, which is there for flat transformations too.
glm::dmat3 matrix_for_normals(const glm::dmat3& m);

// Adds a position, and a normal unless it is null; one that is not finite becomes 0, for which one
// is made. Returns whether the position is finite.
bool add_vertex(const glm::dvec3& position, const glm::dvec3* normal, PolygonModel& model);

// Gives the polygons from `first` on this colour, whose components are held within 0 and 1.
void add_color(std::size_t first, const std::optional<glm::vec3>& color, PolygonModel& model);

// A colour of a file as one of PolygonModel::colors: held within 0 and 1, no_color for a NaN.
glm::vec3 polygon_color(const glm::vec3& color);

// A colour in linear light as the sRGB-encoded one.
glm::vec3 srgb_color(const glm::dvec3& linear);

// Adds the note that so many were left out, unless none were. what: one of them, "line".
void note_left_out(std::size_t count, const char* what, PolygonModel& model);

// "; 2 lines left out, 1 point left out", or nothing without notes.
std::string notes_after_semicolon(const PolygonModel& model);

// Begins a group at the polygon `first`; one that has no polygons yet gives way. A first group that
// begins later leaves those before it to one without a name.
void add_group(std::string name, std::size_t first, std::vector<PolygonGroup>& groups);

// Leaves out a last group without polygons. polygons: how many there are.
void close_groups(std::size_t polygons, std::vector<PolygonGroup>& groups);

}  // namespace trisect
