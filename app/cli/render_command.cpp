#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "app/base/error.h"
#include "app/cli/cache_folder.h"
#include "app/cli/commands.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/statistics.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/pipeline_store.h"
#include "app/frame/supersampling.h"
#include "app/picture/image_file.h"
#include "app/trace/trace_scene.h"

namespace trisect {
int render(const RenderOptions& options) {
  const ImageFormat format = output_format(options.output);
  begin_outputs({options.model}, {options.output, options.stats});
  LoadedScene loaded = load_scene(options);
  const Accel accel = accel_for(options, options.backend, loaded.scene);
  if (needs_bvh(accel, options.shadows)) add_bvh(loaded);

  Output image(options.output);
  OptionalOutput stats(options.stats);

  const bool aovs = format == ImageFormat::exr || options.evals;
  TraceResult traced = trace_showing_progress(
      {options.backend, options.gl_path, options.device, options.validation,
       options.runs.value_or(1), options.runs.has_value(), cache_folder()},
      loaded.scene, loaded.params, {options.solver, aovs, options.evals, accel, options.shadows});
  traced.frame = averaged(std::move(traced.frame), samples_across(options.spp));
  RenderStatistics statistics;
  statistics.accel = accel;
  statistics.camera = loaded.settings.camera;
  statistics.light = loaded.settings.light;
  statistics.shading = loaded.settings.shading;
  statistics.background = loaded.settings.background;
  statistics.background_color = loaded.settings.background_color;
  statistics.device = traced.device;
  statistics.driver = traced.driver;
  statistics.patches = loaded.scene.triangles.size();
  statistics.hits = traced.frame.hits();
  statistics.scene_bytes = device_bytes(loaded.scene);
  if (options.evals) statistics.counts = work_of(traced.frame);
  statistics.frames = traced.frames;
  statistics.load_ms = loaded.load_ms;
  statistics.bake_ms = loaded.bake_ms;
  statistics.bvh_ms = loaded.bvh_ms;
  statistics.upload_ms = traced.upload_ms;

  write_image(
      traced.frame, format, image.file(),
      {options.evals, options.background == Background::none, attributes_of(options, statistics)});
  stats.write(to_json(options, statistics));
  image.commit();
  stats.commit();
  say("{}{}\n", to_text(options, statistics), options.output);

  for (const std::string& message : traced.messages) {
    fmt::print(stderr, "validation: {}\n", message);
  }
  return traced.messages.empty() ? exit_done : exit_internal;
}

}  // namespace trisect
