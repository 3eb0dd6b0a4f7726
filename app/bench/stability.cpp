#include "app/bench/stability.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <random>
#include <utility>

#include "app/accuracy/classify.h"
#include "app/bake/bake.h"
#include "app/bake/subpatch_bounds.h"
#include "app/cli/interrupt.h"
#include "app/cli/progress_line.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/trace_settings.h"
#include "app/oracle/oracle.h"
#include "app/stress/stress_judge.h"
#include "app/stress/stress_scenes.h"

namespace trisect::bench {
namespace {

using glm::dvec3;

// The angle between the rays and the surface on all axes but the one that varies it.
constexpr double kUsualDegrees = 50.0;

struct Axis {
  const char* name;  // as in StabilityAxis, like the next two
  const char* what;
  bool logarithmic;
  std::vector<double> values;
  std::function<Mesh(double)> mesh;
  std::function<double(double)> degrees;  // angle between the rays and the surface
};

struct Solver {
  const char* name;
  uint solver;
  uint shell;
  uint32_t rank;
};

constexpr Solver kSolvers[] = {{"robust", SOLVER_ROBUST, SHELL_NORMAL, 10},
                               {"thesis, Rank 10", SOLVER_BISECT, SHELL_HEIGHT, 10},
                               {"thesis, Rank 30", SOLVER_BISECT, SHELL_HEIGHT, 30}};

// The powers of ten from 10^from to 10^to.
std::vector<double> powers(int from, int to) {
  std::vector<double> values;
  for (int e = from; e <= to; ++e) values.push_back(std::pow(10.0, e));
  return values;
}

// Stretches a mesh along x. Normals transform by the inverse, so that they stay normal to a surface
// that is stretched alike.
Mesh stretched(Mesh mesh, double factor) {
  for (dvec3& position : mesh.positions) position.x *= factor;
  for (dvec3& normal : mesh.normals) {
    normal = glm::normalize(dvec3(normal.x / factor, normal.y, normal.z));
  }
  return mesh;
}

std::vector<Axis> axes() {
  const auto sphere = [](double) { return stress::sphere(1); };
  const auto usual = [](double) { return kUsualDegrees; };
  return {
      {"distance", "distance from the origin, radii", true, powers(0, 6),
       [](double d) { return stress::moved(stress::sphere(1), 1.0, dvec3(0.48, -0.6, 0.64) * d); },
       usual},
      {"scale", "scale of the model", true, powers(-6, 6),
       [](double scale) { return stress::moved(stress::sphere(1), scale, dvec3(0.0)); }, usual},
      {"grazing",
       "angle between ray and surface, degrees",
       true,
       {90.0, 45.0, 20.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4},
       sphere,
       [](double degrees) { return degrees; }},
      {"aspect", "patch's length over its width", true, powers(0, 6),
       [](double aspect) { return stretched(stress::leaning_patch(20.0), aspect); }, usual},
      {"spread",
       "lean of the normals, degrees",
       false,
       {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0, 89.0},
       [](double degrees) { return stress::leaning_patch(degrees); },
       usual}};
}

// Rays at random points of the surface, at this angle to it, from the side to which its normal
// points.
std::vector<CastRay> rays_at(const BakedScene& scene, double degrees, uint32_t count,
                             std::mt19937_64& random) {
  std::vector<CastRay> rays;
  while (rays.size() < count) {
    const stress::SurfacePoint point = stress::any_point(scene, random);
    if (!(glm::length(point.normal) > 0.5)) continue;
    const double angle = glm::radians(degrees);
    const dvec3 direction =
        stress::across(point.normal, random) * std::cos(angle) - point.normal * std::sin(angle);
    rays.push_back(stress::ray_through(scene, point.position, direction));
  }
  return rays;
}

StabilityPoint measure(const Axis& axis, const Solver& solver, double value, uint32_t count) {
  const Mesh mesh = axis.mesh(value);
  const SurfaceChoice choice{SURFACE_PHONG, 0.65, solver.shell};
  const BakedScene scene =
      solver.solver == SOLVER_ROBUST ? bake_with_subpatches(mesh, choice) : bake(mesh, choice);
  // Seeded alike for all values, so that these differ in nothing else.
  std::mt19937_64 random(5);
  const std::vector<CastRay> rays = rays_at(scene, axis.degrees(value), count, random);
  TraceSettings settings = casting_settings(scene);
  settings.solver = solver.solver;
  settings.rank = solver.rank;
  const std::vector<CastHit> hits =
      cast_on_cpu(scene, make_params(scene, settings), solver.solver, rays);
  const std::vector<OracleAnswer> answers = oracle_answers(Oracle(scene), rays, scene.radius);
  StabilityPoint point;
  point.value = value;
  double squares = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const ClassifiedRay ray =
        classify(found_hit(hits[i]), answers[i], to_oracle_ray(rays[i]).direction, scene.radius);
    point.nans += ray.verdict == RayVerdict::not_a_number ? 1 : 0;
    if (!answers[i].decidable) continue;
    ++point.decided;
    point.wrong += ray.verdict == RayVerdict::wrong_hit ? 1 : 0;
    point.missed += ray.verdict == RayVerdict::missed ? 1 : 0;
    if (ray.verdict == RayVerdict::both_miss) continue;
    // A wrong patch or root counts by its distance, like any other error.
    const double off = both_hit(ray.verdict) ? std::min(1.0, ray.off_surface) : 1.0;
    squares += off * off;
  }
  point.error = std::sqrt(squares / static_cast<double>(point.decided));
  return point;
}

}  // namespace

std::vector<StabilityAxis> measure_stability(uint32_t rays) {
  std::vector<StabilityAxis> measured;
  const std::vector<Axis> all = axes();
  uint64_t points = 0;
  for (const Axis& axis : all) points += axis.values.size() * std::size(kSolvers);
  ProgressLine progress("measuring stability", points);
  uint32_t done = 0;
  for (const Axis& axis : all) {
    StabilityAxis result{axis.name, axis.what, axis.logarithmic, {}};
    for (const Solver& solver : kSolvers) {
      StabilityCurve curve{solver.name, {}};
      for (const double value : axis.values) {
        curve.points.push_back(measure(axis, solver, value, rays));
        stop_if_interrupted();
        progress.show(++done);
      }
      result.curves.push_back(std::move(curve));
    }
    measured.push_back(std::move(result));
  }
  return measured;
}

}  // namespace trisect::bench
