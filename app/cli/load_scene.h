// From the command line's model and options to what is traced.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/cli/options.h"
#include "app/cli/progress_line.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/trace_settings.h"
#include "app/trace/trace_scene.h"

namespace trisect {

// What the choice of the acceleration depends on. subgroups: whether the device has their
// operations; it makes no difference if the options name the acceleration.
AccelRequest accel_request(const RenderOptions& options, bool subgroups);

// The acceleration for a scene on that back end. Throws NoDevice if it is the device's to choose
// and no device fits, UsageError if the options ask for what is not possible.
Accel accel_for(const RenderOptions& options, Backend backend, const BakedScene& scene);

// Throws UsageError if the image has too many rays a side.
TraceSettings settings_of(const RenderOptions& options, const Mesh& mesh, const BakedScene& scene);

struct LoadedScene {
  BakedScene scene;
  std::string model_sha256;
  TraceSettings settings;
  TraceParams params;
  double load_ms;
  double bake_ms;
  std::optional<double> bvh_ms;
};

// Reads, bakes and frames the model, and prints a line about it. Throws InputError or UsageError.
LoadedScene load_scene(const RenderOptions& options);

// bake_with_subpatches() with a progress line on the terminal. Throws Interrupted if the user stops
// it.
BakedScene bake_showing_progress(const Mesh& mesh, const SurfaceChoice& choice);

// Reads every file, for a command that measures for long: what cannot be read, or is too
// large or too small, is found before. Throws InputError.
void expect_readable(const std::vector<std::string>& models);

// trace_scene() with a progress line on the terminal. Throws Interrupted if the user stops it.
TraceResult trace_showing_progress(const TraceRequest& request, const BakedScene& scene,
                                   const TraceParams& params, const KernelChoice& choice);

// Builds the tree over the scene's subpatches and measures the time.
void add_bvh(LoadedScene& loaded);

}  // namespace trisect
