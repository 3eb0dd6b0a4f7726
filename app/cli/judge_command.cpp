// The commands rays, cast and judge.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/base/memory.h"
#include "app/cli/cache_folder.h"
#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/json_text.h"
#include "app/cli/load_scene.h"
#include "app/cli/named.h"
#include "app/cli/output.h"
#include "app/cli/progress_line.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/pipeline_store.h"
#include "app/dispatch/ray_caster.h"
#include "app/judge/cast_files.h"
#include "app/judge/hard_rays.h"
#include "app/judge/judged_ray.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/surface/surface_choice.h"

namespace trisect {
namespace {

using glm::dvec3;
using nlohmann::ordered_json;

// The mesh with positions of single precision, as programs have them that rays are exchanged with.
Mesh read_single(const SingleModel& model) {
  const BusyLine line("reading " + model.file);
  BuiltMesh built = build_mesh(read_model(model.file), model.file, model.mesh);
  for (dvec3& position : built.mesh.positions) position = dvec3(glm::vec3(position));
  stop_if_interrupted();
  return std::move(built.mesh);
}

SurfaceChoice choice_of(const SingleModel& model) {
  return {model.surface, model.alpha, model.shell};
}

// In the model's own coordinates, which single precision holds as they are.
BakedScene bake_in_place(const Mesh& mesh, const SingleModel& model) {
  return named(model.file, [&] { return bake_about(mesh, choice_of(model), dvec3(0.0)); });
}

std::vector<FileHit> cast_by(const CastOptions& options, const Mesh& mesh,
                             const std::vector<FileRay>& rays) {
  const auto show = [&](ProgressLine& line) {
    return [&](uint32_t done) { return line.show(done); };
  };
  if (options.backend == Backend::oracle) {
    const BakedScene scene = bake_in_place(mesh, options.model);
    ProgressLine line("casting", rays.size());
    return finished(cast_by_oracle(scene, rays, show(line)));
  }
  BakedScene scene = named(options.model.file,
                           [&] { return bake_showing_progress(mesh, choice_of(options.model)); });
  const TraceParams params = make_params(scene, casting_settings(scene));
  ProgressLine line("casting", rays.size());
  if (options.backend == Backend::cpu) {
    return finished(cast_file_rays(
        scene, rays,
        [&](std::span<const CastRay> casts) {
          return cast_on_cpu(scene, params, SOLVER_ROBUST, casts);
        },
        show(line)));
  }
  const gpu::Instance instance(false);
  const gpu::Device device(instance, options.device);
  const PipelineStore store(device, cache_folder());
  scene.bvh = build_bvh(scene);
  RayCaster caster(device, scene, params, SOLVER_ROBUST);
  return finished(cast_file_rays(
      scene, rays, [&](std::span<const CastRay> casts) { return caster.cast(casts); }, show(line)));
}

const char* verdict_name(RayVerdict verdict) {
  switch (verdict) {
    case RayVerdict::not_a_number:
      return "not a number";
    case RayVerdict::undecidable:
      return "undecidable";
    case RayVerdict::both_miss:
      return "miss";
    case RayVerdict::wrong_hit:
      return "invented";
    case RayVerdict::missed:
      return "missed";
    case RayVerdict::hit:
      return "hit";
    case RayVerdict::wrong_patch:
      return "wrong patch";
    default:
      return "wrong root";
  }
}

const char* place_name(RootPlace place) {
  return place == RootPlace::inside ? "inside" : place == RootPlace::edge ? "edge" : "vertex";
}

// The rays with a wrong answer, as CSV.
std::string wrong_rays(const std::vector<JudgedRay>& rays, const std::vector<FileHit>& hits) {
  std::string text = "ray,verdict,t,triangle,true_t,true_u,true_v,true_triangle,place\n";
  const auto triangle = [](const FileHit& hit) {
    if (hit.triangle == kSomeTriangle) return std::string();
    return hit.triangle == NO_TRIANGLE ? "-1" : std::to_string(hit.triangle);
  };
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const JudgedRay& ray = rays[i];
    const bool is_right = ray.verdict == RayVerdict::hit || ray.verdict == RayVerdict::both_miss ||
                          ray.verdict == RayVerdict::undecidable;
    if (is_right) continue;
    const bool was_hit = hits[i].triangle != NO_TRIANGLE;
    text += fmt::format("{},{},{},{},", i, verdict_name(ray.verdict),
                        was_hit ? fmt::format("{}", hits[i].t) : "", triangle(hits[i]));
    text += ray.truth.triangle == NO_TRIANGLE
                ? ",,,-1,\n"
                : fmt::format("{},{},{},{},{}\n", ray.truth.t, ray.truth.u, ray.truth.v,
                              ray.truth.triangle, place_name(ray.place));
  }
  return text;
}

void print(const JudgeOptions& options, const Judgement& sum, std::size_t triangles) {
  say("{}: {} triangles, surface {}; {} rays, {} of them undecidable\n", options.model.file,
      triangles, surface_name(options.model.surface), sum.rays, sum.undecidable);
  say("right         {:>8}  {} hits and {} misses\n", sum.hits + sum.misses, sum.hits, sum.misses);
  const auto line = [](const char* what, std::size_t count) { say("{:13} {:>8}\n", what, count); };
  line("missed", sum.missed);
  line("invented", sum.invented);
  line("wrong patch", sum.wrong_patch);
  line("wrong root", sum.wrong_root);
  line("not a number", sum.nans);
  if (sum.missed + sum.wrong_patch + sum.wrong_root > 0) {
    say("The right root lies at an edge for {} of them, at a vertex for {}.\n", sum.at_edge,
        sum.at_vertex);
  }
  say("\n{:32} {:>9} {:>9} {:>9}\n", "errors of the right hits", "p50", "p99", "max");
  const auto errors = [](const char* what, const Quantiles& q) {
    say("{:32} {:>9.2g} {:>9.2g} {:>9.2g}\n", what, q.p50, q.p99, q.max);
  };
  errors("along the ray, model's units", sum.length);
  errors("across the surface, radii", sum.across);
  errors("t, units in the last place", sum.ulp);
  errors("u and v", sum.weight);
}

std::string json_of(const JudgeOptions& options, const Judgement& sum, std::size_t triangles) {
  const ordered_json json{{"program", "trisect"},
                          {"version", TRISECT_VERSION},
                          {"rays_file", options.rays},
                          {"hits_file", options.hits},
                          {"model", options.model.file},
                          {"surface", surface_name(options.model.surface)},
                          {"shell", shell_name(options.model.shell)},
                          {"alpha", options.model.alpha},
                          {"triangles", triangles},
                          {"rays", sum.rays},
                          {"undecidable", sum.undecidable},
                          {"hits", sum.hits},
                          {"misses", sum.misses},
                          {"wrong", sum.wrong()},
                          {"missed", sum.missed},
                          {"invented", sum.invented},
                          {"wrong_patch", sum.wrong_patch},
                          {"wrong_root", sum.wrong_root},
                          {"not_a_number", sum.nans},
                          {"at_edge", sum.at_edge},
                          {"at_vertex", sum.at_vertex},
                          {"length", trisect::json_of(sum.length)},
                          {"across", trisect::json_of(sum.across)},
                          {"ulp", trisect::json_of(sum.ulp)},
                          {"weights", trisect::json_of(sum.weight)}};
  return json_text(json);
}

}  // namespace

int write_rays(const RaysOptions& options) {
  begin_outputs({options.model.file}, {options.output});
  Output file(options.output);
  const Mesh mesh = read_single(options.model);
  const BakedScene scene = bake_in_place(mesh, options.model);
  std::vector<FileRay> rays;
  const double all = static_cast<double>(options.count) *
                     static_cast<double>(options.kind == "all" ? kRayKinds.size() : 1);
  // In memory, and as the text of a file.
  expect_memory(all * 3.0 * static_cast<double>(sizeof(FileRay)),
                fmt::format("a list of {} rays", all));
  std::size_t kinds = 0;
  for (const RayKind& kind : kRayKinds) {
    if (options.kind != "all" && options.kind != kind.name) continue;
    ++kinds;
    for (const FileRay& ray : hard_rays(scene, kind.name, options.count, options.seed)) {
      rays.push_back(ray);
    }
    stop_if_interrupted();
  }
  file.file().write(rays_for(options.output, rays));
  file.commit();
  say("{}: {} rays{}\n", options.output, rays.size(),
      kinds == 1 ? "" : fmt::format(", {} of each of {} kinds", options.count, kinds));
  return exit_done;
}

int cast_rays(const CastOptions& options) {
  begin_outputs({options.rays, options.model.file}, {options.output});
  Output file(options.output);
  const std::vector<FileRay> rays = read_rays(options.rays);
  const Mesh mesh = read_single(options.model);
  const std::vector<FileHit> hits = cast_by(options, mesh, rays);
  file.file().write(hits_for(options.output, hits));
  file.commit();
  const auto count = std::count_if(hits.begin(), hits.end(),
                                   [](const FileHit& hit) { return hit.triangle != NO_TRIANGLE; });
  say("{}: {} of {} rays hit\n", options.output, count, rays.size());
  return exit_done;
}

int judge_hits(const JudgeOptions& options) {
  begin_outputs({options.rays, options.hits, options.model.file}, {options.json, options.wrong});
  OptionalOutput json(options.json);
  OptionalOutput wrong(options.wrong);
  const std::vector<FileRay> rays = read_rays(options.rays);
  const std::vector<FileHit> hits = read_hits(options.hits);
  if (hits.size() != rays.size()) {
    throw InputError(fmt::format("{}: there are {} hits for the {} rays of {}.", options.hits,
                                 hits.size(), rays.size(), options.rays));
  }
  const Mesh mesh = read_single(options.model);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].triangle < kSomeTriangle && hits[i].triangle >= mesh.triangles.size()) {
      throw InputError(fmt::format("{}: hit {} names triangle {}, but {} has {}, from 0 on.",
                                   options.hits, i, hits[i].triangle, options.model.file,
                                   mesh.triangles.size()));
    }
  }
  const BakedScene scene = bake_in_place(mesh, options.model);
  const std::vector<JudgedRay> judged = [&] {
    ProgressLine line("judging", rays.size());
    return finished(judged_rays(scene, rays, hits, [&](uint32_t done) { return line.show(done); }));
  }();
  const Judgement sum = sum_of(judged);
  print(options, sum, mesh.triangles.size());
  json.write(json_of(options, sum, mesh.triangles.size()));
  wrong.write(wrong_rays(judged, hits));
  json.commit();
  wrong.commit();
  return sum.wrong() == 0 ? exit_done : exit_different;
}

}  // namespace trisect
