// What the program does, one function a command. They throw what error.h has, or gpu::Error.
#pragma once

#include "app/options.h"

namespace trisect {

// Renders the model to the output file and prints the figures; returns an exit code.
int render(const RenderOptions& options);

// Compares the solvers with the oracle, prints a table; returns exit_different if the robust one
// does not keep its promises.
int accuracy(const AccuracyOptions& options);

// Times the ways to make a frame beside each other and prints a table.
int bench_speed(const BenchOptions& options);

// Measures time against error of every way to draw the models, and writes a report into a folder.
int bench_pareto(const ParetoOptions& options);

// Measures what each step from the thesis's way to this program's is worth, and writes a report
// into a folder.
int bench_ablation(const AblationOptions& options);

// Measures errors over distance, scale and their like, and writes a report into a folder.
int bench_stability(const StabilityOptions& options);

// Measures the solvers on the catalogue of hard cases and prints the table; returns an exit code.
int hardcases(const HardcasesOptions& options);

// Renders with each back end and compares every pair; returns exit_different if one is farther
// apart than tolerance_between() allows.
int crosscheck(const CrosscheckOptions& options);
Tolerance tolerance_between(Backend a, Backend b, GlPath gl_path);

// Compares two image files; returns exit_different if they are farther apart than asked for.
int compare_images(const CompareOptions& options);

// Shows a model in a window until that is closed; returns an exit code.
int view_model(const ViewOptions& options);

// Lists the Vulkan devices; returns an exit code.
int list_devices();

}  // namespace trisect
