// Runs the hard cases and judges the solvers' hits by the oracle's answers: the rows of the table
// that `trisect hardcases` prints.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/oracle/oracle.h"
#include "app/stress/stress_cases.h"

namespace trisect {

// A cast ray for the oracle: its numbers in double precision, its direction of unit length.
OracleRay to_oracle_ray(const CastRay& ray);

// One answer for each ray, computed on all cores. An answer is undecidable if it flips when the ray
// moves by 1e-7 of the scene's radius, or of the distance from the anchor to the hit if that is
// larger.
std::vector<OracleAnswer> oracle_answers(const Oracle& oracle, std::span<const CastRay> rays,
                                         double radius);

// Sums up the verdicts of classify() over the rays: wrong hits, wrong patches and wrong roots are
// `wrong`. hits, answers: one for each ray. radius: the length that errors are measured in, the
// scene's radius or what is used instead. Thread-safe.
CheckedOutcome judge(std::span<const CastRay> rays, std::span<const CastHit> hits,
                     std::span<const OracleAnswer> answers, double radius);

// Counts the decidable rays that first hit a back side. On a closed surface, of rays that begin
// outside, those are rays for which the surface itself has a crack.
std::size_t cracks_seen(std::span<const CastRay> rays, std::span<const OracleAnswer> answers);

// One row of the table: a case on one surface, in one shell, by one solver.
struct StressRow {
  std::string name;
  std::string what;
  StressKind kind = StressKind::shape;
  uint surface = SURFACE_PHONG;
  uint shell = SHELL_NORMAL;
  uint solver = SOLVER_ROBUST;
  uint32_t rank = 10;
  double most_undecidable = kMostUndecidableRays;  // share of the rays
  CheckedOutcome outcome;
  std::string verdict;  // see verdict_of

  // A quantile (from 0 to 1) of outcome.errors, in units of 2^-23 of the radius, which is single
  // precision's rounding step there; 0 if there are no errors.
  [[nodiscard]] double error_ulp(double quantile) const;
  [[nodiscard]] double evaluations_per_ray() const;
  // Whether this row must not fail: the robust solver in the normal shell, which is the only shell
  // of flat triangles.
  [[nodiscard]] bool binding() const;
};

// Nothing wrong, missed or NaN, and errors of at most 2.5e-7 (for 99 of 100 rays) and 2e-6 (for
// all). Rays that are undecidable do not count: verdict_of looks at these.
bool passes(const CheckedOutcome& outcome);

// The robust solver's rows:
//   FAIL       the outcome does not pass, or more rays are undecidable than the row allows
//   undecided  the row allows that no ray is decided, and none is: neither passed nor failed
//   cracks     the hits are right, but the surface itself has cracks
//   pass
// The bisection's rows are not binding. Their depth errors are not judged, for at Rank 10 they are
// about a thousandth of the radius:
//   fails      a hit is wrong, missed or NaN
//   undecided  no ray is decided
//   ok
// cracks: whether cracks_seen() found any on a closed surface.
std::string verdict_of(const StressRow& row, bool cracks);

// Runs one case on one surface. Three rows: robust in the normal shell, robust and bisection in the
// height shell. Flat triangles have the same points in both shells, so there are two rows of them,
// robust and bisection in the normal shell.
std::vector<StressRow> run_rows(const RayCase& ray_case, uint surface,
                                const StressBackend& backend);
// The first of these rows alone.
StressRow run_robust_row(const RayCase& ray_case, uint surface, const StressBackend& backend);
StressRow run_row(const CheckedCase& checked_case, const StressBackend& backend);

// The table's binding rows, counted by verdict.
struct BindingRows {
  std::size_t all = 0;
  std::size_t passed = 0;
  std::size_t undecided = 0;

  // Rows with any other verdict.
  [[nodiscard]] std::size_t failed() const { return all - passed - undecided; }
};
BindingRows count_binding(std::span<const StressRow> rows);

}  // namespace trisect
