// What `trisect bench` does, one function a command. They return exit codes, and throw what
// app/base/error.h has.
#pragma once

#include "app/bench/options.h"

namespace trisect {

// Times the ways to make a frame beside each other and prints a table.
int bench_speed(const BenchOptions& options);

// Measures time against error of every way to draw the models, and writes a report into a folder.
int bench_pareto(const ParetoOptions& options);

// Measures what each step from the thesis's way to this program's is worth, and writes a report
// into a folder.
int bench_ablation(const AblationOptions& options);

// Measures errors over distance, scale and their like, and writes a report into a folder.
int bench_stability(const StabilityOptions& options);

}  // namespace trisect
