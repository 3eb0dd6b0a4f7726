#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/base/error.h"
#include "app/base/stopwatch.h"
#include "app/cli/cache_folder.h"
#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/picture_contents.h"
#include "app/cli/progress_line.h"
#include "app/cli/sequence.h"
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
    return value_text(std::find_if(now.begin(), now.end(), is_named)->value) != then;
  };
  if (differs("device", picture.device) || differs("driver", picture.driver) ||
      differs("program", picture.program) || differs("commit", picture.commit)) {
    say("{} was made by {}, commit {}, on {}, driver {}: here bits may differ\n", file,
        picture.program, picture.commit, picture.device, picture.driver);
  }
}

// Renders pictures of a loaded scene, one after the other, on one device.
class Renderer {
 public:
  Renderer(const RenderOptions& options, const PictureContents& picture, const LoadedScene& loaded,
           Accel accel)
      : options_(options),
        picture_(picture),
        loaded_(loaded),
        accel_(accel),
        request_{options.backend,    options.gl_path,          options.device,
                 options.validation, options.runs.value_or(1), options.runs.has_value(),
                 cache_folder()} {}

  // Renders a frame into its files, which appear when both are whole. step: for the progress line.
  // Returns what is to be said of it. Throws Interrupted.
  RenderStatistics render(const Shot& shot, const TraceSettings& settings,
                          const std::string& step) {
    const ImageFormat format = output_format(shot.image);
    Output image(shot.image);
    OptionalOutput stats(shot.stats);
    const TraceParams params = make_params(loaded_.scene, settings);
    if (!tracer_) {
      const BusyLine line("making the kernels");
      tracer_ = make_tracer(
          request_, loaded_.scene, params.width, params.height,
          {options_.solver, picture_.needs_aovs(), options_.evals, accel_, options_.shadows});
    }

    RenderStatistics statistics;
    {
      ProgressLine line(step);
      statistics.frames = finished(trace_runs(*tracer_, request_, params, frame_,
                                              [&](double done) { return line.show(done); }));
    }
    frame_ = averaged(std::move(frame_), samples_across(options_.spp));
    statistics.source = {settings, accel_, loaded_.model_sha256, tracer_->device(),
                         tracer_->driver()};
    statistics.patches = loaded_.scene.triangles.size();
    statistics.hits = frame_.hits();
    statistics.scene_bytes = device_bytes(loaded_.scene);
    if (options_.evals) statistics.counts = work_of(frame_);
    statistics.load_ms = loaded_.load_ms;
    statistics.bake_ms = loaded_.bake_ms;
    statistics.bvh_ms = loaded_.bvh_ms;
    statistics.upload_ms = tracer_->upload_ms();
    statistics.frame = shot.frame;

    const BusyLine line("writing " + shot.image);
    write_image(frame_, format, image.file(), picture_.of(frame_, options_, statistics.source));
    stats.write(to_json(options_, statistics));
    // Where the image is, the frame is finished.
    stats.commit();
    image.commit();
    return statistics;
  }

  // Lets go of the device and prints the messages of the validation layer; returns an exit code.
  int close() { return report_validation(tracer_ ? tracer_->close() : std::vector<std::string>()); }

 private:
  const RenderOptions& options_;
  const PictureContents& picture_;
  const LoadedScene& loaded_;
  Accel accel_;
  TraceRequest request_;
  std::unique_ptr<SceneTracer> tracer_;
  Frame frame_;
};

// The settings with the camera of a frame.
TraceSettings settings_of(const Shot& shot, const Sequence& sequence, const LoadedScene& loaded) {
  TraceSettings settings = loaded.settings;
  settings.camera = sequence.camera(shot, settings.camera);
  return settings;
}

// Throws InputError, naming the path's file, if the camera of a frame is none.
void expect_cameras(const RenderOptions& options, const Sequence& sequence,
                    const LoadedScene& loaded) {
  for (const Shot& shot : sequence.shots()) {
    try {
      make_params(loaded.scene, settings_of(shot, sequence, loaded));
    } catch (const UsageError&) {
      throw InputError(
          fmt::format("{}: in frame {} the camera looks nowhere, or along its up vector.",
                      options.camera_path, *shot.frame));
    }
  }
}

// Renders the frames of a path but for those that are finished.
void render_path(const RenderOptions& options, const Sequence& sequence, const LoadedScene& loaded,
                 Accel accel, Renderer& renderer) {
  const Stopwatch watch;
  std::size_t rendered = 0;
  std::size_t left = sequence.shots().size();
  for (const Shot& shot : sequence.shots()) {
    const TraceSettings settings = settings_of(shot, sequence, loaded);
    const PictureSource source{settings, accel, loaded.model_sha256, "", ""};
    stop_if_interrupted();
    if (options.resume && is_finished(shot, attributes_of(options, source))) {
      say("{} is there\n", shot.image);
      --left;
      continue;
    }
    const std::string time_left =
        rendered == 0 ? ""
                      : fmt::format(", {} left", duration_text(watch.milliseconds() / 1000.0 *
                                                               static_cast<double>(left) /
                                                               static_cast<double>(rendered)));
    const RenderStatistics statistics =
        renderer.render(shot, settings, fmt::format("frame {}{}", *shot.frame, time_left));
    say("{}: {} pixels hit, gpu {:.1f} ms, wall {:.1f} ms\n", shot.image, statistics.hits,
        statistics.frames[0].gpu_ms, statistics.frames[0].wall_ms);
    ++rendered;
    --left;
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
  if (std::find(options.aovs.begin(), options.aovs.end(), Aov::evals) != options.aovs.end()) {
    options.evals = true;
  }
  const PictureContents picture(format, options);
  const Sequence sequence(options);
  for (const Shot& shot : sequence.shots()) {
    begin_outputs({options.model, options.from, options.camera_path}, {shot.image, shot.stats});
  }
  LoadedScene loaded = load_scene(options);
  if (takes_its_model && loaded.model_sha256 != repeated->model_sha256) {
    throw InputError(
        fmt::format("{}: is not the model of {} any more; named as MODEL it is taken as it is.",
                    options.model, options.from));
  }
  const Accel accel = accel_for(options, options.backend, loaded.scene);
  if (needs_bvh(accel, options.shadows)) add_bvh(loaded);

  Renderer renderer(options, picture, loaded, accel);
  if (sequence.is_path()) {
    expect_cameras(options, sequence, loaded);
    render_path(options, sequence, loaded, accel, renderer);
    return renderer.close();
  }
  const RenderStatistics statistics =
      renderer.render(sequence.shots().front(), loaded.settings, "rendering");
  say("{}{}\n", to_text(options, statistics), options.output);
  if (repeated) {
    say_what_differs(options.from, *repeated, attributes_of(options, statistics.source));
  }
  return renderer.close();
}

}  // namespace trisect
