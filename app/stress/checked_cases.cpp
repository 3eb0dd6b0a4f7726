// Hard images and hard files: cases that are not lists of rays, each with a check of its own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/dispatch/camera.h"
#include "app/dispatch/trace_settings.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/obj_file.h"
#include "app/oracle/oracle_tracer.h"
#include "app/stress/stress_cases.h"
#include "app/stress/stress_judge.h"
#include "app/stress/stress_scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

BakedScene robust_scene(const Mesh& mesh) {
  return bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_NORMAL});
}

// A pixel's ray, rounded to single precision like the kernel's.
CastRay rounded(const OracleRay& ray) {
  return {vec4(glm::vec3(ray.origin), static_cast<float>(ray.t_min)),
          vec4(glm::vec3(ray.direction), 0.0F)};
}

bool all_finite(const vec4& color, const PixelAovs& aovs) {
  const vec4 sum = color + aovs.normal_z + aovs.geometric_u + vec4(aovs.v);
  return std::isfinite(sum.x) && std::isfinite(sum.y) && std::isfinite(sum.z) &&
         std::isfinite(sum.w);
}

// Renders an image and judges every pixel by the oracle. Depths in an image count from the eye, and
// their rounding grows with the eye's distance, so errors are taken relative to that distance where
// it exceeds the radius.
CheckedOutcome judged_image(const StressBackend& backend, const BakedScene& scene,
                            const TraceSettings& settings) {
  const TraceParams params = make_params(scene, settings);
  const Frame frame = backend.render(scene, params, {SOLVER_ROBUST, true, true});
  std::vector<CastRay> rays;
  std::vector<CastHit> hits;
  std::size_t nans = 0;
  for (uint32_t y = 0; y < settings.height; ++y) {
    for (uint32_t x = 0; x < settings.width; ++x) {
      const std::size_t pixel = std::size_t{y} * settings.width + x;
      const PixelAovs& aovs = frame.aovs[pixel];
      const OraclePixelRay ray = oracle_pixel_ray(params, x, y);
      rays.push_back(rounded(ray.ray));
      const auto z = static_cast<float>(static_cast<double>(aovs.normal_z.w) - ray.anchor_distance);
      hits.push_back({z, aovs.geometric_u.w, aovs.v, aovs.triangle, aovs.evaluations, 0, 0, 0});
      nans += all_finite(frame.colors[pixel], aovs) ? 0 : 1;
    }
  }
  const double eye = glm::length(dvec3(params.eye));
  CheckedOutcome outcome = judge(rays, hits, oracle_answers(Oracle(scene), rays, scene.radius),
                                 std::max(scene.radius, eye));
  outcome.nans = std::max(outcome.nans, nans);
  return outcome;
}

TraceSettings framed(const Mesh& mesh, const BakedScene& scene, uint32_t width, uint32_t height,
                     double fov) {
  TraceSettings settings;
  settings.width = width;
  settings.height = height;
  settings.camera = framing_camera(mesh.positions, scene.origin, fov, {0.0, 1.0, 0.0},
                                   static_cast<double>(width) / static_cast<double>(height));
  return settings;
}

CheckedOutcome image_of_sphere(const StressBackend& backend, uint32_t width, uint32_t height,
                               double fov) {
  const Mesh mesh = stress::sphere();
  const BakedScene scene = robust_scene(mesh);
  return judged_image(backend, scene, framed(mesh, scene, width, height, fov));
}

// The eye is so near to the surface that a part of it lies in front of the near plane.
CheckedOutcome clipped_by_near_plane(const StressBackend& backend) {
  const BakedScene scene = robust_scene(stress::sphere());
  const stress::SurfacePoint point = stress::point_at(scene, 0, dvec3(1.0 / 3.0));
  TraceSettings settings;
  settings.width = 40;
  settings.height = 30;
  settings.camera.fov = 120.0;
  settings.camera.eye = point.position + point.normal * (0.7e-3 * scene.radius) + scene.origin;
  settings.camera.target = settings.camera.eye - point.normal + dvec3(0.3, 0.1, 0.2);
  return judged_image(backend, scene, settings);
}

// One patch covers the whole image.
CheckedOutcome filled_by_one_patch(const StressBackend& backend) {
  const Mesh mesh = stress::leaning_patch(30.0);
  const BakedScene scene = robust_scene(mesh);
  TraceSettings settings;
  settings.width = 40;
  settings.height = 30;
  settings.camera.eye = dvec3(0.0, 0.4, 0.75);
  settings.camera.target = dvec3(0.01, 0.35, 0.0);
  settings.camera.fov = 40.0;
  return judged_image(backend, scene, settings);
}

// The image is too large to judge by the oracle. It may have no NaN, and about the same share of
// its pixels must hit as in a small image.
CheckedOutcome large_image(const StressBackend& backend) {
  constexpr uint32_t width = 8192;
  constexpr uint32_t height = 128;
  const Mesh mesh = stress::sphere();
  const BakedScene scene = robust_scene(mesh);
  const TraceSettings settings = framed(mesh, scene, width, height, 45.0);
  const Frame frame = backend.render(scene, make_params(scene, settings), {SOLVER_ROBUST});
  CheckedOutcome outcome;
  outcome.rays = std::size_t{width} * height;
  for (const vec4& color : frame.colors) {
    outcome.nans += all_finite(color, PixelAovs{}) ? 0 : 1;
  }
  TraceSettings small = settings;
  small.width = width / 64;
  small.height = height / 64;
  const Frame coarse = backend.render(scene, make_params(scene, small), {SOLVER_ROBUST});
  // Each pixel of the small image stands for 64 by 64 pixels, of which not all hit on the outline.
  const double expected = static_cast<double>(coarse.hits()) * 64.0 * 64.0;
  const double found = static_cast<double>(frame.hits());
  if (found < 0.5 * expected) outcome.missed = static_cast<std::size_t>(expected - found);
  if (found > 1.5 * expected) outcome.wrong = static_cast<std::size_t>(found - expected);
  outcome.note = "stand-in of 8192x128 for 8192x8192, judged by its share of hits";
  return outcome;
}

const char* const kTetrahedron =
    "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\n"
    "f 1//1 3//3 2//2\nf 1//1 2//2 4//4\nf 1//1 4//4 3//3\nf 2//2 3//3 4//4\n";

// A tetrahedron in OBJ text, with these four lines of normals.
std::string with_normals(const std::string& normals) {
  return normals + kTetrahedron;
}

// The file must be refused as bad input.
CheckedOutcome expect_refusal(const std::string& text) {
  CheckedOutcome outcome;
  outcome.rays = 1;
  try {
    build_mesh(parse_obj(text, "hard.obj"), "hard.obj");
    outcome.wrong = 1;
    outcome.note = "accepted";
  } catch (const InputError& error) {
    outcome.note = fmt::format("refused: {}", error.what());
  }
  return outcome;
}

// The file must be accepted, and rays at its model are judged by the oracle.
CheckedOutcome expect_met(const StressBackend& backend, const std::string& text) {
  const Mesh mesh = build_mesh(parse_obj(text, "hard.obj"), "hard.obj").mesh;
  const BakedScene scene = robust_scene(mesh);
  std::mt19937_64 random(7);
  const std::vector<CastRay> rays = stress::rays_at_surface(scene, random, 200);
  const std::vector<CastHit> hits =
      backend.cast(scene, make_params(scene, casting_settings(scene)), SOLVER_ROBUST, rays);
  return judge(rays, hits, oracle_answers(Oracle(scene), rays, scene.radius), scene.radius);
}

CheckedOutcome one_triangle(const StressBackend& backend) {
  return expect_met(backend, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

// A level plane of n by n squares, with rays from above: the right depth is known.
CheckedOutcome many_triangles(const StressBackend& backend) {
  constexpr int n = 500;  // a storage buffer of 128 MiB holds 591
  const Mesh mesh = stress::height_grid(n, 0.0, 0.0);
  const BakedScene scene = robust_scene(mesh);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-0.9, 0.9);
  std::vector<CastRay> rays;
  rays.reserve(64);
  for (int i = 0; i < 64; ++i) {
    rays.push_back(stress::ray_exactly_through(scene, {unit(random), unit(random), 0.0},
                                               {0.3 * unit(random), 0.3 * unit(random), -1.0}));
  }
  const std::vector<CastHit> hits =
      backend.cast(scene, make_params(scene, casting_settings(scene)), SOLVER_ROBUST, rays);
  CheckedOutcome outcome;
  outcome.rays = rays.size();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    outcome.evaluations += hits[i].evaluations;
    outcome.missed += hits[i].triangle == NO_TRIANGLE ? 1 : 0;
    outcome.nans += std::isfinite(hits[i].z) ? 0 : 1;
    const double slant = std::abs(static_cast<double>(rays[i].direction.z));
    outcome.errors.push_back(std::abs(static_cast<double>(hits[i].z)) * slant / scene.radius);
  }
  outcome.note = fmt::format("stand-in of {} triangles for 1,000,000; judged by analysis",
                             mesh.triangles.size());
  return outcome;
}

void add_images(std::vector<CheckedCase>& cases) {
  const auto add = [&](const char* name, const char* what,
                       std::function<CheckedOutcome(const StressBackend&)> run) {
    cases.push_back({name, what, StressKind::image, std::move(run)});
  };
  add("one-patch-fills-image", "every pixel sees one patch", filled_by_one_patch);
  add("fov-1", "field of view of 1 degree",
      [](const StressBackend& backend) { return image_of_sphere(backend, 40, 30, 1.0); });
  add("fov-170", "field of view of 170 degrees",
      [](const StressBackend& backend) { return image_of_sphere(backend, 40, 30, 170.0); });
  add("near-plane", "the near plane cuts the surface", clipped_by_near_plane);
  add("image-1x1", "one pixel",
      [](const StressBackend& backend) { return image_of_sphere(backend, 1, 1, 45.0); });
  add("image-1x4096", "one column",
      [](const StressBackend& backend) { return image_of_sphere(backend, 1, 4096, 45.0); });
  add("image-8192x8192", "67 million pixels", large_image);
}

void add_data(std::vector<CheckedCase>& cases) {
  const auto refused = [&](const char* name, const char* what, const std::string& text) {
    cases.push_back({name, what, StressKind::data,
                     [text](const StressBackend& /*backend*/) { return expect_refusal(text); }});
  };
  const auto met = [&](const char* name, const char* what, const std::string& normals) {
    cases.push_back({name, what, StressKind::data, [normals](const StressBackend& backend) {
                       return expect_met(backend, with_normals(normals));
                     }});
  };
  const std::string rest = "vn -1 -1 1\nvn -1 1 -1\nvn 1 -1 -1\n";
  refused("nan-normal", "a normal that is no number", with_normals("vn nan 1 1\n" + rest));
  refused("infinite-normal", "an infinite normal", with_normals("vn inf 1 1\n" + rest));
  refused("overflowing-normal", "a normal beyond double precision",
          with_normals("vn 1e999 1 1\n" + rest));
  met("denormal-normal", "a normal of denormal numbers", "vn 1e-310 1e-310 1e-310\n" + rest);
  met("zero-normal", "a normal of no length", "vn 0 0 0\n" + rest);
  met("unnormalised-normals", "normals of lengths from 1e-200 to 1e200",
      "vn 1e200 1e200 1e200\nvn -1e-200 -1e-200 1e-200\nvn -5 5 -5\nvn 1e-3 -1e-3 -1e-3\n");
  refused("nan-position", "a position that is no number", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refused("infinite-position", "an infinite position", "v -inf 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  cases.push_back({"one-triangle", "a model of one triangle", StressKind::data, one_triangle});
  cases.push_back({"million-triangles", "very many triangles", StressKind::data, many_triangles});
}

}  // namespace

std::vector<CheckedCase> stress_checked_cases() {
  std::vector<CheckedCase> cases;
  add_images(cases);
  add_data(cases);
  return cases;
}

}  // namespace trisect
