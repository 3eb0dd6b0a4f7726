// The commands of the program, one function each. They throw the exceptions of app/base/error.h,
// and Interrupted.
#pragma once

#include "app/cli/options.h"

namespace trisect {

// Renders the model to the output file and prints the figures; returns an exit code.
int render(RenderOptions options);

// Puts images of parts together; returns an exit code.
int stitch_parts(const StitchOptions& options);

// Compares the solvers with the oracle and prints a table. Returns exit_different if the robust
// solver does not keep its promises.
int accuracy(const AccuracyOptions& options);

// Measures the solvers on the catalogue of hard cases and prints the table; returns an exit code.
int hardcases(const HardcasesOptions& options);

// Renders with each back end and compares every pair of frames. Returns exit_different if a pair is
// farther apart than tolerance_between() allows.
int crosscheck(const CrosscheckOptions& options);
Tolerance tolerance_between(Backend a, Backend b, GlPath gl_path);

// Renders, proves what each pixel's ray hits, and holds the two against each other. Returns
// exit_different if an answer is proven wrong.
int certify(const CertifyOptions& options);

// Compares two image files. Returns exit_different if they are farther apart than the tolerance.
int compare_images(const CompareOptions& options);

// Prints what a model is like, what its curved surfaces will be like, and what to look at.
int info(const InfoOptions& options);

// Writes the curved surface as flat triangles. Returns exit_different if the bound is larger than
// the error asked for.
int export_mesh(const ExportOptions& options);

// Writes rays on which ray tracers fail.
int write_rays(const RaysOptions& options);

// Writes what rays of a file hit first.
int cast_rays(const CastOptions& options);

// Judges the hits that any program found for rays of a file, and prints the figures. Returns
// exit_different if one is wrong.
int judge_hits(const JudgeOptions& options);

// Lists the Vulkan devices, or the one asked for, and on request what their arithmetic does.
// Returns exit_no_device if none can be used.
int list_devices(const DevicesOptions& options);

}  // namespace trisect
