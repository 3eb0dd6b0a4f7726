// The double-precision reference: all points where a ray meets the curved triangles, by a search of
// its own (patch_search.h), the first of them, and whether single precision could tell it.
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

// Hits are two-sided. Safe to use from several threads.
class Oracle {
 public:
  // The scene's baked numbers, widened to double precision, are the truth. Keeps no reference.
  explicit Oracle(const BakedScene& scene);

  // All roots with t_min <= t <= t_max, sorted by t. On a shared edge both triangles have one.
  [[nodiscard]] std::vector<OracleRoot> roots_of(uint32_t triangle, const OracleRay& ray) const;
  [[nodiscard]] std::vector<OracleRoot> roots(const OracleRay& ray) const;

  // The first root. Undecidable where the answer flips when the ray is moved sideways by `motion`,
  // a distance, in four directions, or its ends along it: from hit to miss, or to a t farther off
  // than a surface at the hit's slant would move it. Rays that meet a patch squarely, away from its
  // border and with no other part of a patch within twice `motion`, are not moved: they are
  // decidable.
  [[nodiscard]] OracleAnswer first(const OracleRay& ray, double motion) const;

 private:
  struct Search;
  [[nodiscard]] Search search(const OracleRay& ray, double margin) const;
  [[nodiscard]] bool suspicious(const OracleRay& ray, const Search& found, double motion) const;
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
// on those threads. progress: as parallel_rows has it, of rows; nothing is returned if it says
// stop. What any of the three throws stops the work and is thrown on.
std::optional<OracleFrame> oracle_frame(
    const Oracle& oracle, uint32_t width, uint32_t height,
    const std::function<OracleRay(uint32_t x, uint32_t y)>& ray_of,
    const std::function<double(const OracleRay&)>& motion_of, const Progress& progress);

}  // namespace trisect
