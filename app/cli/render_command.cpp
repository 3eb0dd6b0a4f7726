#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "app/base/error.h"
#include "app/cli/cache_folder.h"
#include "app/cli/commands.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/picture_contents.h"
#include "app/cli/statistics.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/pipeline_store.h"
#include "app/frame/supersampling.h"
#include "app/picture/image_file.h"
#include "app/trace/trace_scene.h"

namespace trisect {
namespace {

// Says where this program and its device are not those that made the picture, which may then differ
// in its last bits.
void say_what_differs(const std::string& file, const SavedPicture& picture,
                      const std::vector<ImageAttribute>& now) {
  const auto differs = [&](const char* name, const std::string& then) {
    const auto is_named = [&](const ImageAttribute& attribute) { return attribute.name == name; };
    return value_text(*std::find_if(now.begin(), now.end(), is_named)) != then;
  };
  if (differs("device", picture.device) || differs("driver", picture.driver) ||
      differs("program", picture.program) || differs("commit", picture.commit)) {
    say("{} was made by {}, commit {}, on {}, driver {}: here bits may differ\n", file,
        picture.program, picture.commit, picture.device, picture.driver);
  }
}

}  // namespace

int render(RenderOptions options) {
  std::optional<SavedPicture> repeated;
  if (!options.from.empty()) repeated = saved_picture(options.from);
  const bool takes_its_model = options.model.empty() && repeated;
  if (takes_its_model) options.model = repeated->model;
  if (options.model.empty()) throw UsageError("MODEL is required (see trisect --help)");
  const ImageFormat format = output_format(options.output);
  if (repeated && options.aovs.empty() && !repeated->aovs.empty() && format == ImageFormat::exr) {
    options.aovs = parse_aovs(options.from, repeated->aovs);
  }
  const PictureContents picture(format, options);
  begin_outputs({options.model, options.from}, {options.output, options.stats});
  LoadedScene loaded = load_scene(options);
  if (takes_its_model && loaded.model_sha256 != repeated->model_sha256) {
    throw InputError(
        fmt::format("{}: is not the model of {} any more; named as MODEL it is taken as it is.",
                    options.model, options.from));
  }
  const Accel accel = accel_for(options, options.backend, loaded.scene);
  if (needs_bvh(accel, options.shadows)) add_bvh(loaded);

  Output image(options.output);
  OptionalOutput stats(options.stats);

  TraceResult traced = trace_showing_progress(
      {options.backend, options.gl_path, options.device, options.validation,
       options.runs.value_or(1), options.runs.has_value(), cache_folder()},
      loaded.scene, loaded.params,
      {options.solver, picture.needs_aovs(), options.evals, accel, options.shadows});
  traced.frame = averaged(std::move(traced.frame), samples_across(options.spp));
  RenderStatistics statistics;
  statistics.source = {loaded.settings, accel, loaded.model_sha256, traced.device, traced.driver};
  statistics.patches = loaded.scene.triangles.size();
  statistics.hits = traced.frame.hits();
  statistics.scene_bytes = device_bytes(loaded.scene);
  if (options.evals) statistics.counts = work_of(traced.frame);
  statistics.frames = traced.frames;
  statistics.load_ms = loaded.load_ms;
  statistics.bake_ms = loaded.bake_ms;
  statistics.bvh_ms = loaded.bvh_ms;
  statistics.upload_ms = traced.upload_ms;

  const ImageContents contents = picture.of(traced.frame, options, statistics.source);
  write_image(traced.frame, format, image.file(), contents);
  stats.write(to_json(options, statistics));
  image.commit();
  stats.commit();
  say("{}{}\n", to_text(options, statistics), options.output);
  if (repeated) say_what_differs(options.from, *repeated, contents.attributes);

  for (const std::string& message : traced.messages) {
    fmt::print(stderr, "validation: {}\n", message);
  }
  return traced.messages.empty() ? exit_done : exit_internal;
}

}  // namespace trisect
