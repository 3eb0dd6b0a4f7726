// The table and the JSON of `trisect accuracy`.
#pragma once

#include <cstddef>
#include <string>

#include "app/accuracy/accuracy.h"
#include "app/report/columns.h"
#include "app/surface/surface_choice.h"

namespace trisect {

// One solver's frame of one model, surface and shell.
struct AccuracyRow {
  std::string model;  // path of the file
  SurfaceChoice choice;
  uint solver = SOLVER_ROBUST;
  Accuracy accuracy;
  // Pixels in which the CPU's frame has other bits of the hit, the patch, Z, U or V.
  std::size_t cpu_differs = 0;
  double gpu_ms = 0.0;
  std::string verdict;  // "pass" or "FAIL"; empty for solvers that promise nothing
};

const report::Columns<AccuracyRow>& accuracy_columns();

std::string accuracy_table_header();

}  // namespace trisect
