// The robust solver in single precision, on rays where rounding errors could change the result.
#include <gtest/gtest.h>

#include <cmath>

#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/kernel_float.h"
#include "app/dispatch/trace_settings.h"
#include "app/oracle/oracle_tracer.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

// Expects that the kernel finds the oracle's first root in the pixels `first` to `last` of a row of
// an image of 800x600 pixels of a model's sphere surface.
void expect_first_roots(const char* asset, uint shell, uint row, uint first, uint last) {
  const Mesh mesh = test::load_asset(asset);
  const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_SPHERE, 0.0, shell});
  const TraceSettings settings = framed_settings(mesh, scene, 800, 600);
  const TraceParams params = make_params(scene, settings);
  in_float::Kernel kernel = in_float::kernel_of(scene, params, {SOLVER_ROBUST, false, false});
  const Oracle oracle(scene);
  for (uint x = first; x <= last; ++x) {
    const in_float::Kernel::PixelRay ray = kernel.pixel_ray({x, row});
    in_float::Traversal traversal = kernel.begin_traversal(1 << 20);
    kernel.resume(ray, 0, traversal);
    ASSERT_TRUE(kernel.is_finished(ray, traversal));
    const in_float::Hit hit = kernel.hit_of(ray, traversal);
    const OraclePixelRay asked = oracle_pixel_ray(params, x, row);
    const OracleAnswer answer = oracle.first(asked.ray, kMotion * asked.anchor_distance);
    if (!answer.decidable) continue;
    ASSERT_EQ(hit.triangle != NO_TRIANGLE, answer.hit) << x;
    if (!answer.hit) continue;
    // The distance of the kernel's hit from the surface: a few rounding errors.
    const double across = (static_cast<double>(hit.z) - answer.root.t - asked.anchor_distance) *
                          std::abs(glm::dot(answer.root.normal, asked.ray.direction));
    EXPECT_LT(std::abs(across), 2e-6 * scene.radius) << x << " in shell " << shell;
  }
}

// One of these rays grazes a patch with a vertex at the scene's origin, whose own rounding errors
// are 0 and tell nothing of those of the other vertices. Both of its roots lie on a bump as high as
// a hundred-thousandth of the model's size, the second 0.013 behind the first. The other rays are
// its neighbours.
TEST(Roundings, MeetsTheFirstOfTwoCloseRootsNextToTheOrigin) {
  for (const uint shell : {SHELL_NORMAL, SHELL_HEIGHT}) {
    expect_first_roots("saddle", shell, 286, 430, 449);
  }
}

// The first root lies next to the curve where the lines of the shell become tangent to a vertex's
// sphere and beyond which they miss it. Near it sigma is off by several tolerances.
TEST(Roundings, MeetsARootBesideWhereLinesBeginToMissASphere) {
  expect_first_roots("teapot", SHELL_NORMAL, 216, 498, 504);
}

}  // namespace
}  // namespace trisect
