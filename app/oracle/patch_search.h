// All points where a line meets one curved patch: the reference that solvers are judged by.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "app/surface/patch_range.h"
#include "app/surface/surface_choice.h"
#include "app/surface/surface_double.h"

namespace trisect {

// A line, with two axes across it. The direction and the axes are of unit length and at right
// angles.
struct Line {
  glm::dvec3 origin;
  glm::dvec3 direction;
  glm::dvec3 across[2];
};

// direction: of unit length.
Line line_along(const glm::dvec3& origin, const glm::dvec3& direction);

// What a search is to report and what it found. Call clear() before each search.
struct PatchFindings {
  struct Root {
    double t;            // distance along the line from its origin
    glm::dvec3 weights;  // of the vertices; down to -1e-12
    glm::dvec3 normal;   // S_u x S_v, unit length
  };

  explicit PatchFindings(double margin_) : margin(margin_) {}

  // Where the surface may come this near the line without meeting it is reported in `doubt_t`.
  double margin;
  std::vector<Root> roots;  // in no order
  // The least t at which the surface may meet the line, or come within the margin of it, without
  // that a root was found there; infinite if there is none.
  double doubt_t;
  void clear();
};

// One patch, and the first levels of a quadtree of its sub-triangles with their enclosures.
//
// The search divides the patch in four until a sub-triangle's enclosure (proven, patch_range.h) is
// off the line, or the surface over the sub-triangle, projected along the line, does not fold: then
// it holds one root at most, and Newton's iteration finds it or ends elsewhere. Whether it folds is
// told from proven ranges of the tangents S_u and S_v (tangent_range.h).
class PatchSearch {
 public:
  // Keeps the enclosures of `levels` divisions: (4^(levels + 1) - 1) / 3, of some 800 bytes each.
  PatchSearch(const SurfaceChoice& choice, const Triangle& tri, int levels);

  // Adds to `findings` the roots on the patch, among them every one with t between these; some may
  // lie beyond. Safe to call from several threads at a time, each with findings of its own.
  void roots(const Line& line, double t_min, double t_max, PatchFindings& findings) const;

  // The least t between these at which a vertex, which is a point of the surface, is this near the
  // line; infinite if none is.
  [[nodiscard]] double first_vertex(const Line& line, double t_min, double t_max,
                                    double distance) const;

  [[nodiscard]] double longest_edge() const { return patch_.longest; }

 private:
  // Over a sub-triangle each component of S_u and S_v is this, give or take that of off_u and
  // off_v.
  struct Tangents {
    glm::dvec3 S_u;
    glm::dvec3 S_v;
    glm::dvec3 off_u;
    glm::dvec3 off_v;
  };
  struct Node {
    in_double::SubTriangle sub_triangle;
    Enclosure enclosure;
    std::optional<Tangents> tangents;  // nothing where none are proven
    // By the mean value theorem: S at the centre and what the tangents add from there. Its count is
    // 0 if it is not used.
    Enclosure tangent_enclosure;
  };
  struct Point {
    glm::dvec3 S;
    glm::dvec3 S_u;
    glm::dvec3 S_v;
  };
  struct Query;

  [[nodiscard]] Node node_of(const in_double::SubTriangle& sub_triangle) const;
  [[nodiscard]] std::optional<Tangents> tangents_of(
      const in_double::SubTriangle& sub_triangle) const;
  [[nodiscard]] Enclosure enclose_by_tangents(const in_double::SubTriangle& sub_triangle,
                                              const Tangents& tangents) const;
  [[nodiscard]] Point evaluate(const glm::dvec3& weights) const;
  [[nodiscard]] bool is_torn(const Enclosure& enclosure, int depth) const;
  static bool is_one_to_one(const Tangents& tangents, const glm::dvec3& direction);
  static std::optional<double> meet(const Enclosure& enclosure, const Query& query,
                                    PatchFindings& findings);
  void visit(const Node& node, std::size_t index, int depth, const Query& query,
             PatchFindings& findings) const;
  [[nodiscard]] bool newton(const Query& query, double step, PatchFindings::Root& root) const;
  void search_unresolved(const Node& node, double t, const Query& query,
                         PatchFindings& findings) const;

  SurfaceChoice choice_;
  Patch patch_;
  in_double::Shape shape_;
  in_double::Triangle tri_;
  bool defined_;             // false: there is no surface (has_surface)
  std::vector<Node> nodes_;  // the children of node i are 4 i + 1 to 4 i + 4
};

}  // namespace trisect
