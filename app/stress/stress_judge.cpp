#include "app/stress/stress_judge.h"

#include <algorithm>
#include <cmath>

#include "app/accuracy/classify.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/parallel_rows.h"
#include "app/dispatch/trace_settings.h"

namespace trisect {
namespace {

using glm::dvec3;

constexpr double kUlp = 0x1p-23;

// Casts by bisection. It marches from its ray's origin, which is the anchor, and would not find
// what lies before that. So each anchor moves to where its ray begins.
std::vector<CastHit> bisect_from_start(const StressBackend& backend, const BakedScene& scene,
                                       const TraceParams& params, std::span<const CastRay> rays) {
  std::vector<CastRay> moved(rays.begin(), rays.end());
  for (CastRay& ray : moved) {
    const dvec3 start =
        dvec3(ray.anchor) + dvec3(ray.direction) * static_cast<double>(ray.anchor.w);
    ray.anchor = vec4(glm::vec3(start), 0.0F);
  }
  std::vector<CastHit> hits = backend.cast(scene, params, SOLVER_BISECT, moved);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].triangle != NO_TRIANGLE) hits[i].z += rays[i].anchor.w;
  }
  return hits;
}

// What the rows of a case in the same shell share.
struct Prepared {
  BakedScene scene;
  TraceParams params;
  std::vector<CastRay> rays;
  std::vector<OracleAnswer> answers;
};

Prepared prepare(const RayCase& ray_case, uint surface, uint shell) {
  Prepared prepared;
  prepared.scene = bake_with_subpatches(ray_case.mesh(), {surface, ray_case.alpha, shell});
  TraceSettings settings = casting_settings(prepared.scene);
  settings.rank = ray_case.rank;
  prepared.params = make_params(prepared.scene, settings);
  std::mt19937_64 random(7);
  prepared.rays = ray_case.rays(prepared.scene, random);
  std::shuffle(prepared.rays.begin(), prepared.rays.end(), random);
  prepared.rays.resize(std::min(prepared.rays.size(), ray_case.most_rays));
  prepared.answers = oracle_answers(Oracle(prepared.scene), prepared.rays, prepared.scene.radius);
  return prepared;
}

StressRow row_of(const RayCase& ray_case, const Prepared& prepared, uint solver,
                 const StressBackend& backend) {
  const BakedScene& scene = prepared.scene;
  StressRow row{ray_case.name,
                ray_case.what,
                ray_case.kind,
                scene.choice.surface,
                scene.choice.shell,
                solver,
                ray_case.rank,
                ray_case.most_undecidable,
                {},
                {}};
  const std::vector<CastHit> hits =
      solver == SOLVER_BISECT ? bisect_from_start(backend, scene, prepared.params, prepared.rays)
                              : backend.cast(scene, prepared.params, solver, prepared.rays);
  row.outcome = judge(prepared.rays, hits, prepared.answers, scene.radius);
  const bool cracks = ray_case.closed && cracks_seen(prepared.rays, prepared.answers) > 0;
  row.verdict = verdict_of(row, cracks);
  return row;
}

}  // namespace

OracleRay to_oracle_ray(const CastRay& ray) {
  return {dvec3(ray.anchor), glm::normalize(dvec3(ray.direction)),
          static_cast<double>(ray.anchor.w)};
}

std::vector<OracleAnswer> oracle_answers(const Oracle& oracle, std::span<const CastRay> rays,
                                         double radius) {
  std::vector<OracleAnswer> answers(rays.size());
  const auto answer = [&](uint32_t i) {
    const OracleRay ray = to_oracle_ray(rays[i]);
    answers[i] = oracle.first(ray, 1e-7 * radius);
    const double distance = answers[i].hit ? std::abs(answers[i].root.t) : 0.0;
    if (distance > radius) answers[i] = oracle.first(ray, 1e-7 * distance);
  };
  parallel_rows(static_cast<uint32_t>(rays.size()), answer, {});
  return answers;
}

CheckedOutcome judge(std::span<const CastRay> rays, std::span<const CastHit> hits,
                     std::span<const OracleAnswer> answers, double radius) {
  CheckedOutcome outcome;
  outcome.rays = rays.size();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    outcome.evaluations += hits[i].evaluations;
    const ClassifiedRay ray =
        classify(found_hit(hits[i]), answers[i], to_oracle_ray(rays[i]).direction, radius);
    switch (ray.verdict) {
      case RayVerdict::both_miss:
        break;
      case RayVerdict::not_a_number:
        ++outcome.nans;
        break;
      case RayVerdict::undecidable:
        ++outcome.undecidable;
        break;
      case RayVerdict::missed:
        ++outcome.missed;
        break;
      case RayVerdict::wrong_hit:
      case RayVerdict::wrong_patch:
      case RayVerdict::wrong_root:
        ++outcome.wrong;
        break;
      case RayVerdict::hit:
        outcome.errors.push_back(ray.off_surface);
        break;
    }
  }
  std::sort(outcome.errors.begin(), outcome.errors.end());
  return outcome;
}

std::size_t cracks_seen(std::span<const CastRay> rays, std::span<const OracleAnswer> answers) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!answers[i].decidable || !answers[i].hit) continue;
    if (glm::dot(to_oracle_ray(rays[i]).direction, answers[i].root.normal) > 0.0) ++seen;
  }
  return seen;
}

double StressRow::error_ulp(double quantile) const {
  if (outcome.errors.empty()) return 0.0;
  const double last = static_cast<double>(outcome.errors.size() - 1);
  return outcome.errors[static_cast<std::size_t>(std::ceil(quantile * last))] / kUlp;
}

double StressRow::evaluations_per_ray() const {
  return outcome.rays == 0 ? 0.0 : outcome.evaluations / static_cast<double>(outcome.rays);
}

bool StressRow::binding() const {
  return solver == SOLVER_ROBUST && (shell == SHELL_NORMAL || surface == SURFACE_FLAT);
}

bool passes(const CheckedOutcome& outcome) {
  if (outcome.wrong + outcome.missed + outcome.nans > 0) return false;
  if (outcome.errors.empty()) return true;
  const double last = static_cast<double>(outcome.errors.size() - 1);
  const double p99 = outcome.errors[static_cast<std::size_t>(std::ceil(0.99 * last))];
  return p99 <= 2.5e-7 && outcome.errors.back() <= 2e-6;
}

std::string verdict_of(const StressRow& row, bool cracks) {
  const CheckedOutcome& outcome = row.outcome;
  const bool none_decided = outcome.undecidable == outcome.rays;
  if (row.solver == SOLVER_BISECT) {
    if (outcome.wrong + outcome.missed + outcome.nans > 0) return "fails";
    return none_decided ? "undecided" : "ok";
  }
  const double most = row.most_undecidable * static_cast<double>(outcome.rays);
  if (!passes(outcome) || static_cast<double>(outcome.undecidable) > most) return "FAIL";
  if (none_decided) return "undecided";
  return cracks ? "cracks" : "pass";
}

std::vector<StressRow> run_rows(const RayCase& ray_case, uint surface,
                                const StressBackend& backend) {
  std::vector<StressRow> rows;
  const Prepared normal = prepare(ray_case, surface, SHELL_NORMAL);
  rows.push_back(row_of(ray_case, normal, SOLVER_ROBUST, backend));
  if (surface == SURFACE_FLAT) {
    rows.push_back(row_of(ray_case, normal, SOLVER_BISECT, backend));
    return rows;
  }
  const Prepared height = prepare(ray_case, surface, SHELL_HEIGHT);
  rows.push_back(row_of(ray_case, height, SOLVER_ROBUST, backend));
  rows.push_back(row_of(ray_case, height, SOLVER_BISECT, backend));
  return rows;
}

StressRow run_robust_row(const RayCase& ray_case, uint surface, const StressBackend& backend) {
  return row_of(ray_case, prepare(ray_case, surface, SHELL_NORMAL), SOLVER_ROBUST, backend);
}

StressRow run_row(const CheckedCase& checked_case, const StressBackend& backend) {
  StressRow row;
  row.name = checked_case.name;
  row.what = checked_case.what;
  row.kind = checked_case.kind;
  row.outcome = checked_case.run(backend);
  std::sort(row.outcome.errors.begin(), row.outcome.errors.end());
  row.verdict = verdict_of(row, false);
  return row;
}

BindingRows count_binding(std::span<const StressRow> rows) {
  BindingRows count;
  for (const StressRow& row : rows) {
    if (!row.binding()) continue;
    ++count.all;
    if (row.verdict == "pass") ++count.passed;
    if (row.verdict == "undecided") ++count.undecided;
  }
  return count;
}

}  // namespace trisect
