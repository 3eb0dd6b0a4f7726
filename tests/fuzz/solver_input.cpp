#include <array>
#include <cmath>
#include <vector>

#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/kernel_float.h"
#include "app/dispatch/trace_settings.h"
#include "app/mesh/mesh_builder.h"
#include "app/oracle/oracle.h"
#include "app/stress/stress_scenes.h"
#include "tests/fuzz/answers.h"
#include "tests/support/garbage.h"

namespace trisect::fuzz {
namespace {

using in_float::Kernel;

const std::array<SurfaceChoice, 5> kChoices{{{SURFACE_FLAT, 0.65, SHELL_NORMAL},
                                             {SURFACE_PHONG, 0.65, SHELL_NORMAL},
                                             {SURFACE_PHONG, 0.65, SHELL_HEIGHT},
                                             {SURFACE_SPHERE, 0.65, SHELL_NORMAL},
                                             {SURFACE_SPHERE, 0.65, SHELL_HEIGHT}}};

TraceSettings one_pixel() {
  TraceSettings settings;
  settings.width = 1;
  settings.height = 1;
  settings.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45.0};
  return settings;
}

// The kernel's traversal of one ray. Some rays take millions of evaluations, which is right, but
// they are left on their way.
in_float::Traversal traverse(Kernel& kernel, const Kernel::PixelRay& ray, uint64_t most) {
  constexpr int steps = 4096;
  constexpr uint passes = 8;
  in_float::Traversal traversal = kernel.begin_traversal(steps);
  for (uint pass = 0; pass < passes && (pass == 0 || !kernel.is_finished(ray, traversal)); ++pass) {
    traversal.steps = steps;
    kernel.resume(ray, pass, traversal);
    expect(traversal.counts.evaluations <= most, "more evaluations than their bound");
  }
  return traversal;
}

// The float members of an object from its beginning on.
template <typename Object>
void add_numbers(Object& object, std::size_t count, std::vector<float*>& numbers) {
  static_assert(std::is_trivially_copyable_v<Object>);
  auto* first = reinterpret_cast<float*>(&object);
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(first + i);
}

// Any of the numbers that kernels read are any bits.
void overwrite_and_cast(const SurfaceChoice& choice, Numbers& input) {
  static const std::array<BakedScene, 5> baked = [] {
    std::array<BakedScene, 5> scenes;
    for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i] = test::two_subpatches(kChoices[i]);
    return scenes;
  }();
  BakedScene scene = baked[static_cast<std::size_t>(
      std::find(kChoices.begin(), kChoices.end(), choice) - kChoices.begin())];
  TraceParams params = make_params(scene, one_pixel());
  CastRay cast{vec4(0, 0, 5, -10), vec4(0, 0, -1, 0)};
  std::vector<float*> numbers;
  for (Triangle& triangle : scene.triangles) {
    add_numbers(triangle, sizeof(Triangle) / sizeof(float), numbers);
  }
  for (SubpatchBounds& bounds : scene.subpatches) {
    add_numbers(bounds, offsetof(SubpatchBounds, triangle) / sizeof(float), numbers);
    numbers.push_back(&bounds.gradient_lipschitz);
  }
  add_numbers(params, offsetof(TraceParams, width) / sizeof(float), numbers);
  add_numbers(params.alpha, 3, numbers);
  add_numbers(cast, sizeof(CastRay) / sizeof(float), numbers);
  while (!input.has_ended()) {
    float& number = *numbers[input.next<uint8_t>() % numbers.size()];
    number = input.next<float>();
  }

  for (const uint solver : {SOLVER_ROBUST, SOLVER_BISECT}) {
    const uint64_t most = solver == SOLVER_ROBUST
                              ? test::most_evaluations(scene)
                              : uint64_t{params.triangle_count} * (params.rank - 1);
    Kernel kernel = in_float::kernel_of(scene, params, {solver, true, true});
    for (const Kernel::PixelRay& ray : {kernel.ray_of_cast(cast), kernel.pixel_ray({0, 0})}) {
      const in_float::Traversal traversal = traverse(kernel, ray, most);
      if (!kernel.is_finished(ray, traversal)) continue;
      const uint triangle = kernel.hit_of(ray, traversal).triangle;
      expect(triangle == NO_TRIANGLE || triangle < scene.triangles.size(), "a hit of no triangle");
      vec4 color;
      PixelAovs aovs{};
      kernel.finish_pixel(ray, traversal, color, aovs);
    }
  }
}

glm::dvec3 vector_from(Numbers& input) {
  const auto x = input.next<float>();
  const auto y = input.next<float>();
  const auto z = input.next<float>();
  return {x, y, z};
}

void expect_hit_on_patch(const BakedScene& scene, const CastRay& cast, const CastHit& hit) {
  if (hit.triangle == NO_TRIANGLE) return;
  expect(hit.triangle < scene.triangles.size(), "a hit of no triangle");
  expect(std::isfinite(hit.z) && std::isfinite(hit.u) && std::isfinite(hit.v),
         "a hit that is not finite");
  expect(hit.z >= cast.anchor.w, "a hit before the ray begins");
  constexpr float beyond = 1e-3F;
  expect(hit.u >= -beyond && hit.v >= -beyond && hit.u + hit.v <= 1.0F + beyond,
         "a hit beside its triangle");
  const glm::dvec4 domain = scene.triangles[hit.triangle].Domain;
  const glm::dvec3 place = glm::dvec3(cast.anchor) + double{hit.z} * glm::dvec3(cast.direction);
  expect(glm::distance(place, glm::dvec3(domain)) <= domain.w + 1e-4 * scene.radius,
         "a hit outside of its patch's ball");
}

void expect_roots(const BakedScene& scene, const CastRay& cast) {
  const OracleRay ray{glm::dvec3(cast.anchor), glm::normalize(glm::dvec3(cast.direction)),
                      double{cast.anchor.w}};
  for (const OracleRoot& root : Oracle(scene).roots(ray)) {
    expect(std::isfinite(root.t) && root.t >= ray.t_min, "a root before the ray begins");
    for (int i = 0; i < 3; ++i) {
      expect(root.weights[i] >= -1e-9 && root.weights[i] <= 1.0 + 1e-9, "a root beside its patch");
    }
  }
}

// A triangle that is baked as any other, and a ray through its surroundings.
void bake_and_cast(const SurfaceChoice& choice, Numbers& input) {
  std::array<glm::dvec3, 3> positions;
  std::array<glm::dvec3, 3> normals;
  for (glm::dvec3& position : positions) position = vector_from(input);
  for (glm::dvec3& normal : normals) normal = vector_from(input);
  const BakedScene scene = bake_with_subpatches(
      build_mesh(positions, normals, std::array<uint32_t, 3>{0, 1, 2}).mesh, choice);
  const TraceParams params = make_params(scene, one_pixel());
  for (int i = 0; i < 4 && !input.has_ended(); ++i) {
    const glm::dvec3 point = vector_from(input) * scene.radius;
    const glm::dvec3 direction = vector_from(input);
    const double length = glm::length(direction);
    if (!(glm::length(point) <= 10.0 * scene.radius && length > 1e-30 && length < 1e30)) continue;
    const CastRay cast = stress::ray_exactly_through(scene, point, direction / length);
    for (const uint solver : {SOLVER_ROBUST, SOLVER_BISECT}) {
      const uint64_t most = solver == SOLVER_ROBUST
                                ? test::most_evaluations(scene)
                                : uint64_t{params.triangle_count} * (params.rank - 1);
      Kernel kernel = in_float::kernel_of(scene, params, {solver, false, true});
      const Kernel::PixelRay ray = kernel.ray_of_cast(cast);
      const in_float::Traversal traversal = traverse(kernel, ray, most);
      if (!kernel.is_finished(ray, traversal)) continue;
      const CastHit hit = kernel.cast_result(ray, traversal);
      if (solver == SOLVER_ROBUST) expect_hit_on_patch(scene, cast, hit);
    }
    expect_roots(scene, cast);
  }
}

}  // namespace

void solver_input(Bytes bytes) {
  Numbers input(bytes);
  const auto choice = input.next<uint8_t>();
  const SurfaceChoice& surface = kChoices[choice % kChoices.size()];
  expect_answer(
      [&] { choice < 128 ? overwrite_and_cast(surface, input) : bake_and_cast(surface, input); });
}

}  // namespace trisect::fuzz
