#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/base/error.h"
#include "app/base/stopwatch.h"
#include "app/certify/certified_picture.h"
#include "app/certify/certifier.h"
#include "app/cli/cache_folder.h"
#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/json_text.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/cli/progress_line.h"
#include "app/oracle/oracle_tracer.h"
#include "app/trace/trace_scene.h"

namespace trisect {
namespace {

using nlohmann::ordered_json;

// Wrong pixels that are printed, and that JSON lists.
constexpr std::size_t kPrintedPixels = 10;
constexpr std::size_t kListedPixels = 1000;

const char* wrong_name(RayVerdict verdict) {
  switch (verdict) {
    case RayVerdict::wrong_hit:
      return "hit, where a miss is proven";
    case RayVerdict::missed:
      return "missed, where a hit is proven";
    case RayVerdict::wrong_patch:
      return "another patch than is proven";
    case RayVerdict::wrong_root:
      return "another root than is proven";
    default:
      return "not a number";
  }
}

std::size_t count_of(const CertifiedAnswers& answers, RayVerdict verdict) {
  return static_cast<std::size_t>(std::count_if(
      answers.wrong.begin(), answers.wrong.end(),
      [&](const CertifiedAnswers::Wrong& wrong) { return wrong.verdict == verdict; }));
}

void print(const ReasonCounts& counts, const CertifiedAnswers& answers, const std::string& who) {
  std::size_t pixels = 0;
  for (const std::size_t count : counts) pixels += count;
  for (std::size_t i = 0; i < kReasons.size(); ++i) {
    const Reason reason = kReasons[i];
    const char* what = !is_proven(reason) ? "open" : reason == Reason::one_root ? "hit" : "miss";
    if (!is_proven(reason) && counts[i] == 0) continue;
    say("{:>10}  {:>8.4f}%  {}: {}\n", counts[i],
        100.0 * static_cast<double>(counts[i]) / static_cast<double>(pixels), what,
        reason_name(reason));
  }
  say("{}: {} hits and {} misses agree with the proofs, {} do not; {} pixels are open\n", who,
      answers.right_hits, answers.right_misses, answers.wrong.size(), answers.open);
  if (answers.right_hits > 0) {
    say("the hits that agree are off by p50 {:.1e}, p99 {:.1e}, max {:.1e} of the scene's radius\n",
        answers.off_surface.p50, answers.off_surface.p99, answers.off_surface.max);
  }
  for (std::size_t i = 0; i < std::min(answers.wrong.size(), kPrintedPixels); ++i) {
    const CertifiedAnswers::Wrong& wrong = answers.wrong[i];
    say("pixel {},{}: {}\n", wrong.x, wrong.y, wrong_name(wrong.verdict));
  }
  if (answers.wrong.size() > kPrintedPixels) {
    say("and {} more\n", answers.wrong.size() - kPrintedPixels);
  }
}

ordered_json json_of(const ReasonCounts& counts, const CertifiedAnswers& answers) {
  ordered_json json;
  for (std::size_t i = 0; i < kReasons.size(); ++i) {
    std::string name = reason_name(kReasons[i]);
    std::replace(name.begin(), name.end(), ' ', '_');
    json["reasons"][name] = counts[i];
  }
  json["right_hits"] = answers.right_hits;
  json["right_misses"] = answers.right_misses;
  json["open"] = answers.open;
  json["wrong"] = answers.wrong.size();
  json["wrong_hits"] = count_of(answers, RayVerdict::wrong_hit);
  json["missed"] = count_of(answers, RayVerdict::missed);
  json["wrong_patches"] = count_of(answers, RayVerdict::wrong_patch);
  json["wrong_roots"] = count_of(answers, RayVerdict::wrong_root);
  json["nans"] = count_of(answers, RayVerdict::not_a_number);
  json["off_surface"] = trisect::json_of(answers.off_surface);
  json["wrong_pixels"] = ordered_json::array();
  for (std::size_t i = 0; i < std::min(answers.wrong.size(), kListedPixels); ++i) {
    const CertifiedAnswers::Wrong& wrong = answers.wrong[i];
    json["wrong_pixels"].push_back(
        {{"x", wrong.x}, {"y", wrong.y}, {"what", wrong_name(wrong.verdict)}});
  }
  return json;
}

}  // namespace

int certify(const CertifyOptions& options) {
  const RenderOptions& render = options.render;
  const bool draws = !options.picture.empty();
  const ImageFormat format = draws ? output_format(options.picture) : ImageFormat::png;
  begin_outputs({render.model}, {options.picture, options.json});
  std::optional<Output> picture;
  if (draws) picture.emplace(options.picture);
  OptionalOutput json_file(options.json);

  LoadedScene loaded = load_scene(render);
  const Accel accel = accel_for(render, render.backend, loaded.scene);
  if (needs_bvh(accel, false)) add_bvh(loaded);
  const TraceResult traced = trace_showing_progress(
      {render.backend, render.gl_path, render.device, false, 1, false, cache_folder()},
      loaded.scene, loaded.params, {render.solver, true, false, accel, false});

  const Stopwatch watch;
  const Certifier certifier = [&] {
    ProgressLine line("enclosing the patches", loaded.scene.triangles.size());
    return finished(Certifier::make(loaded.scene, [&](uint32_t done) { return line.show(done); }));
  }();
  const CertifiedFrame proofs = [&] {
    ProgressLine line("proving", loaded.params.height);
    return finished(
        certify_frame(certifier, loaded.params, [&](uint32_t done) { return line.show(done); }));
  }();
  const double milliseconds = watch.milliseconds();
  const CertifiedAnswers answers = judge_answers(traced.frame, proofs, loaded.scene, loaded.params);
  const ReasonCounts counts = count_reasons(proofs);
  const std::string who =
      fmt::format("{}, {}", backend_name(render.backend), solver_name(render.solver));
  print(counts, answers, who);

  ordered_json json{{"model", render.model},
                    {"surface", surface_name(render.surface)},
                    {"shell", shell_name(render.shell)},
                    {"alpha", render.alpha},
                    {"backend", backend_name(render.backend)},
                    {"device", traced.device},
                    {"driver", traced.driver},
                    {"solver", solver_name(render.solver)},
                    {"accel", accel_name(accel)},
                    {"width", render.width},
                    {"height", render.height},
                    {"tube_radius", kMotion * static_cast<double>(loaded.params.anchor.w)},
                    {"proof_ms", milliseconds}};
  json.update(json_of(counts, answers));
  json_file.write(json_text(json));
  if (picture) write_image(reason_picture(proofs, answers), format, picture->file());
  json_file.commit();
  if (picture) picture->commit();
  return answers.wrong.empty() ? exit_done : exit_different;
}

}  // namespace trisect
