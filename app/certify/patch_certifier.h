// What the rays of a tube meet on one curved patch, proven by interval arithmetic in double
// precision. Every bound holds for the baked numbers in exact arithmetic; none rests on samples.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/certify/certificate.h"
#include "app/surface/patch_range.h"
#include "app/surface/surface_choice.h"
#include "app/surface/tangent_range.h"

namespace trisect {

// Why nothing could be proven.
enum class Doubt {
  border,    // the rays meet the patch on both sides of its border
  fold,      // the surface may turn away from the rays within the tube: they graze it
  nonsmooth  // no bound of the tangents is known there
};

// What the rays meet on the patches of a scene. Call clear() before each search.
struct TubeFindings {
  // Every ray of the tube meets the patch here, once in `piece`.
  struct Root {
    uint32_t triangle;
    in_double::SubTriangle piece;
    glm::dvec3 weights;
    double weight_radius;  // of the weights 1 and 2
    Interval t;
  };
  struct Open {
    Doubt doubt;
    double t;  // from here on
  };

  void clear();
  void leave_open(Doubt doubt, double t);
  void add(const Certificate& certificate) const;

  std::vector<Root> roots;
  std::vector<Open> open;
  // Pieces beyond this need not be looked at: the last t of the first root that is proven, or where
  // it is open already whether there is one.
  double t_end = kInfinity;
  int pieces = 0;              // of the patch that is searched
  bool used_tangents = false;  // whether Krawczyk's operator proved something, or only hulls
  std::vector<Certificate>* certificates = nullptr;  // gets every certificate, if set
};

class MeanValueForm;

// The search divides the patch in four until each piece
// - is off the tube, before its beginning or behind a root: by an enclosure (patch_range.h), or by
//   the mean value theorem with ranges of the tangents (tangent_range.h);
// - or is proven to hold one root for every ray of the tube, or none, by Krawczyk's operator with
//   the ranges of the tangents: Krawczyk 1969, "Newton-Algorithmen zur Bestimmung von Nullstellen
//   mit Fehlerschranken"; Neumaier 1990, "Interval Methods for Systems of Equations", section 5.1;
// - or is so small that it stays open, or hardly larger than the tube, or one of very many.
class PatchCertifier {
 public:
  // Without a surface.
  PatchCertifier() = default;
  // Keeps the enclosures of `levels` divisions. tri: baked, as the kernels have it.
  PatchCertifier(const SurfaceChoice& choice, const Triangle& tri, uint32_t index, int levels);

  // What one takes, about.
  static double bytes_of(const SurfaceChoice& choice, int levels);

  // Adds what it finds. Safe to call from several threads, each with findings of its own.
  void search(const RayTube& tube, TubeFindings& findings) const;

 private:
  // The surface over a sub-triangle is no farther than `radius` from the hull of these points of
  // it: corners of smaller ones, whose flat triangles it keeps near to (sphere_chord_bound).
  struct FlatPieces {
    std::vector<glm::dvec3> points;
    double radius = 0.0;
  };
  struct Node {
    in_double::SubTriangle sub_triangle;
    Enclosure enclosure;
    // Of the sphere surface, where it is kept; else it has no points.
    FlatPieces flat;
  };

  [[nodiscard]] Node node_of(const in_double::SubTriangle& sub_triangle) const;
  [[nodiscard]] FlatPieces flat_pieces_of(const in_double::SubTriangle& sub_triangle,
                                          int divisions) const;
  [[nodiscard]] Interval extent(const Enclosure& enclosure, const glm::dvec3& origin,
                                const glm::dvec3& axis) const;
  [[nodiscard]] Interval extent_of(const Node& node, const glm::dvec3& origin,
                                   const glm::dvec3& axis) const;
  void visit(const Node& node, std::size_t index, int depth, const RayTube& tube,
             TubeFindings& findings) const;
  [[nodiscard]] bool is_off(const Node& node, const Interval& t, const RayTube& tube,
                            TubeFindings& findings) const;
  void leave_open(const in_double::SubTriangle& core, Doubt doubt, double t,
                  TubeFindings& findings) const;
  [[nodiscard]] glm::dvec3 newton(const in_double::SubTriangle& piece, const RayTube& tube) const;
  [[nodiscard]] std::optional<Doubt> prove_by_tangents(const in_double::SubTriangle& core,
                                                       const RayTube& tube, TubeFindings& findings,
                                                       std::optional<MeanValueForm>& form) const;

  SurfaceChoice choice_;
  Patch patch_{};
  in_double::Shape shape_{};
  uint32_t index_ = 0;
  double roundings_ = 0.0;   // of a point of the patch, a length
  bool defined_ = false;     // false: there is no surface (has_surface)
  std::vector<Node> nodes_;  // the children of node i are 4 i + 1 to 4 i + 4
};

}  // namespace trisect
