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

// A line with two axes across it; all three of unit length and at right angles.
struct Line {
  glm::dvec3 origin;
  glm::dvec3 direction;
  glm::dvec3 across[2];
};

// direction: of unit length.
Line line_along(const glm::dvec3& origin, const glm::dvec3& direction);

// What a search is asked for and what it found, over one or several patches.
struct PatchFindings {
  struct Root {
    double t;
    glm::dvec3 weights;
    glm::dvec3 normal;  // S_u x S_v, unit length
  };

  explicit PatchFindings(double margin_) : margin(margin_) {}

  // Parts of a patch that come this near the line without meeting it are reported in `doubt_t`.
  double margin;
  std::vector<Root> roots;  // of the patch searched last, in no order
  // The least t at which a part may meet the line, or come within the margin of it, that yielded no
  // root; infinite if there is none.
  double doubt_t;
  void clear();
};

// One patch and a tree of its parts with their enclosures.
//
// The search divides the patch in four until a part's enclosure (proven, patch_range.h) is off the
// line or the part projects across the line without folding, so that it holds one root at most and
// Newton's iteration finds it or goes elsewhere. Whether it folds is told from balls around the
// tangents S_u and S_v: exact for flat triangles and for phong in the normal shell, where they are
// quadratic in w; from six samples, their spread taken half again, for the others.
class PatchSearch {
 public:
  // Keeps the enclosures of 4^levels parts and of those that they were made from.
  PatchSearch(const SurfaceChoice& choice, const Triangle& tri, int levels);

  // Adds to `findings` every root with t between these.
  void roots(const Line& line, double t_min, double t_max, PatchFindings& findings) const;

  [[nodiscard]] double longest_edge() const { return patch_.longest; }

 private:
  // Balls that hold S_u and S_v over a part.
  struct Tangents {
    glm::dvec3 S_u;
    glm::dvec3 S_v;
    double radius_u;
    double radius_v;
    bool proven;  // else six samples' spread
  };
  struct Node {
    Part part;
    Enclosure enclosure;
    Tangents tangents;
    // The mean value theorem's: S at the part's centre plus the tangents' span. None if they are
    // not proven.
    Enclosure tangent_enclosure;
  };
  struct Point {
    glm::dvec3 S;
    glm::dvec3 S_u;
    glm::dvec3 S_v;
  };
  struct Query;

  [[nodiscard]] Node node_of(const Part& part) const;
  [[nodiscard]] Tangents tangents_of(const Part& part) const;
  [[nodiscard]] Enclosure enclose_by_tangents(const Part& part, const Tangents& tangents) const;
  [[nodiscard]] Point evaluate(const glm::dvec3& weights) const;
  [[nodiscard]] bool is_torn(const Enclosure& enclosure, int depth) const;
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
  bool defined_;  // false: every S is NaN
  bool quadratic_tangents_;
  std::vector<Node> nodes_;  // the children of node i are 4 i + 1 to 4 i + 4
};

}  // namespace trisect
