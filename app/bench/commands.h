// The subcommands of `trisect bench`, one function each. They return exit codes and throw the
// exceptions of app/base/error.h, and Interrupted.
#pragma once

#include "app/bench/options.h"

namespace trisect {

// Times several ways to render a frame and prints a table.
int bench_speed(const BenchOptions& options);

// Measures time against error of every way to draw the models, and writes a report into a folder.
int bench_pareto(const ParetoOptions& options);

// Measures the effect of each step from the thesis's tracer to this program's, and writes a report
// into a folder.
int bench_ablation(const AblationOptions& options);

// Measures how near models come to a shape, by flat and by curved triangles, and writes a report
// into a folder.
int bench_shape(const ShapeOptions& options);

// Measures what shadows of flat triangles do to smooth surfaces, and writes a report into a folder.
int bench_terminator(const TerminatorOptions& options);

// Measures errors over distance, scale and other parameters, and writes a report into a folder.
int bench_stability(const StabilityOptions& options);

}  // namespace trisect
