// Judges a solver's hits by the oracle's answers, and the rows of the table of hard cases.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/oracle/oracle.h"
#include "app/stress/stress_cases.h"

namespace trisect {

// A cast ray as the oracle sees it: its floats widened, its direction of unit length.
OracleRay to_oracle_ray(const CastRay& ray);

// One answer for each ray, on all cores. The motion is 1e-7 of the distance from the anchor to the
// hit, at least of the scene's radius.
std::vector<OracleAnswer> oracle_answers(const Oracle& oracle, std::span<const CastRay> rays,
                                         double radius);

// Rays that are not decidable count as such and as nothing else, but for NaNs. A hit is wrong where
// the oracle misses, where it is another triangle at another depth (neighbours that meet within
// 1e-6 of the radius tie), or another root of the same one (a hundredth of the radius off). Errors
// are those of hits that are not wrong: |depth error| |n.v| over the radius.
CheckedOutcome judge(std::span<const CastRay> rays, std::span<const CastHit> hits,
                     std::span<const OracleAnswer> answers, double radius);

// Of answers for a closed surface: decidable rays from outside that first meet a back.
std::size_t cracks_seen(std::span<const CastRay> rays, std::span<const OracleAnswer> answers);

// One line of the table.
struct StressRow {
  std::string name;
  std::string what;
  StressKind kind = StressKind::shape;
  uint surface = SURFACE_PHONG;
  uint shell = SHELL_NORMAL;
  uint solver = SOLVER_ROBUST;
  uint32_t rank = 10;
  CheckedOutcome outcome;
  std::string verdict;  // pass, FAIL, cracks; fails or ok for the bisection

  // Of outcome.errors, in units of single precision's 2^-23 of the radius; 0 if there are none.
  [[nodiscard]] double error_ulp(double quantile) const;
  [[nodiscard]] double evaluations_per_ray() const;
  // Whether it is a row that must pass: robust in the normal shell.
  [[nodiscard]] bool binding() const;
};

// Nothing wrong, missed or NaN, and errors of at most 2.5e-7 (99 of 100) and 2e-6 (all).
bool passes(const CheckedOutcome& outcome);
// cracks: whether the oracle itself sees some.
std::string verdict_of(const StressRow& row, bool cracks);

// Runs one case on one surface: robust in the normal shell, robust and bisect in the height shell
// (for flat, where shells are the same, robust and bisect).
std::vector<StressRow> run_rows(const RayCase& stress, uint surface, const StressBackend& backend);
// The first of these alone.
StressRow run_robust_row(const RayCase& stress, uint surface, const StressBackend& backend);
StressRow run_row(const CheckedCase& stress, const StressBackend& backend);

}  // namespace trisect
