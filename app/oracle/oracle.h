// The double-precision reference: all points where a ray meets the curved triangles, by a search
// that shares no code with the robust solver but the formulas of the surface (patch_search.h); the
// first of them; and whether single precision can decide on it.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/oracle/box_tree.h"
#include "app/oracle/patch_search.h"

namespace trisect {

struct OracleRay {
  glm::dvec3 origin;     // relative to the scene's origin, as the baked triangles are
  glm::dvec3 direction;  // unit length
  double t_min = 0.0;
  double t_max = std::numeric_limits<double>::infinity();
};

struct OracleRoot {
  double t;  // distance along the ray
  uint32_t triangle;
  glm::dvec3 weights;  // of the vertices; down to -1e-12
  glm::dvec3 normal;   // geometric, S_u x S_v, unit length
};

struct OracleAnswer {
  bool hit = false;
  bool decidable = true;
  OracleRoot root{};
};

// Both sides of a triangle are hit. Safe to use from several threads.
class Oracle {
 public:
  // The numbers that the kernels take, widened to double precision, are the truth, so that an
  // answer differs from a kernel's by the kernel's own roundings and by nothing else:
  //  - positions, normals, N.n of the height shell, curvatures and angles: as baked;
  //  - alpha: rounded to single precision, as make_params() rounds it;
  //  - a pixel's ray: the anchor, the axes and the pixel's width of TraceParams
  //    (oracle_pixel_ray), not the eye and the near plane, with which kernels only cull and shade;
  //  - a cast ray: its anchor and direction; the light: that of TraceParams.
  // Three numbers are not taken as they are. The kernels take a direction for a unit vector and the
  // camera's axes for orthonormal, which they are to 6e-8: here directions are normalised, and what
  // that changes is one of the kernels' roundings. Face normals are computed from the positions
  // anew: the roots do not depend on them, what is proven about folds does. A shadow ray starts
  // from the oracle's own hit: a kernel's start is off by its hit's error. Keeps no reference.
  explicit Oracle(const BakedScene& scene);

  // All roots with t_min <= t <= t_max, sorted by t; of one triangle, or of the scene. On a shared
  // edge both triangles have one. roots_of throws std::out_of_range if there is no such triangle.
  [[nodiscard]] std::vector<OracleRoot> roots_of(uint32_t triangle, const OracleRay& ray) const;
  [[nodiscard]] std::vector<OracleRoot> roots(const OracleRay& ray) const;

  // The first root. It is undecidable if the answer changes when the ray is moved sideways by
  // `motion`, a distance, in four directions, or its ends are moved along it by as much: from hit
  // to miss, or to a t that is farther off than the slant of the surface explains; or if a vertex
  // lies so near the ray before the answer. A ray that meets
  // a patch squarely, away from its border, with no surface in doubt before the hit, is decidable
  // without being moved.
  [[nodiscard]] OracleAnswer first(const OracleRay& ray, double motion) const;

 private:
  struct Search;
  [[nodiscard]] Search search(const OracleRay& ray, double margin) const;
  [[nodiscard]] bool suspicious(const OracleRay& ray, const Search& found, double motion) const;
  [[nodiscard]] bool passes_vertex(const OracleRay& ray, const OracleAnswer& answer,
                                   double motion) const;
  [[nodiscard]] bool survives_motion(const OracleRay& ray, const OracleAnswer& answer,
                                     double motion) const;

  std::vector<PatchSearch> patches_;
  BoxTree tree_;
};

struct OracleFrame {
  uint32_t width;
  uint32_t height;
  std::vector<OracleAnswer> pixels;  // row by row
};

// One answer for each pixel, on as many threads as the machine has. ray_of and motion_of are called
// on those threads, at the same time. progress counts rows, as parallel_rows has it; nothing is
// returned if it stops the work. What any of the three throws stops the work and is thrown here.
std::optional<OracleFrame> oracle_frame(
    const Oracle& oracle, uint32_t width, uint32_t height,
    const std::function<OracleRay(uint32_t x, uint32_t y)>& ray_of,
    const std::function<double(const OracleRay&)>& motion_of, const Progress& progress);

}  // namespace trisect
