// From the command line's model and options to what is traced.
#pragma once

#include <optional>

#include "app/bake.h"
#include "app/options.h"
#include "app/trace_settings.h"

namespace trisect {

// Throws UsageError if the image has too many rays a side.
TraceSettings settings_of(const RenderOptions& options, const Mesh& mesh, const BakedScene& scene);

struct LoadedScene {
  BakedScene scene;
  TraceParams params;
  double load_ms;
  double bake_ms;
  std::optional<double> bvh_ms;
};

// Reads, bakes and frames the model, and prints a line about it. Throws InputError or UsageError.
LoadedScene load_scene(const RenderOptions& options);

// Builds the tree over the scene's parts.
void add_bvh(LoadedScene& loaded);

}  // namespace trisect
